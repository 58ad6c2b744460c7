"""Refusals as rows of a table: what is asked, an arrow, and what the refusal names."""

import json
import shlex

import httpx

from tests.support.asking import assert_problem
from tests.support.command import run


def assert_refused(client, call, body, row):
    """A row is `{"what": "is changed in the body"} -> /pointer to what is wrong, and words of the refusal`."""
    change, named = row.split(" -> ")
    refused = client.post(call, json=body | json.loads(change))
    assert refused.status_code in (httpx.codes.REQUEST_ENTITY_TOO_LARGE, httpx.codes.UNPROCESSABLE_ENTITY)
    assert_problem(refused, refused.status_code, named)


def assert_refused_in_one_line(row, code=2, begin="Error: ", **how):
    """A row is `a command -> the words with which its refusal begins ... words that stand in it`."""
    line, named = row.split(" -> ")
    first, _, words = named.partition(" ... ")
    done = run(*shlex.split(line), **how)
    assert (done.returncode, done.stdout, done.stderr.count("\n")) == (code, "", 1), done.stderr
    assert done.stderr.startswith(f"{begin}{first}"), done.stderr
    assert [word for word in words.split() if word not in done.stderr] == [], done.stderr
