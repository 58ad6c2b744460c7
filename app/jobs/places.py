"""Places where the command finds jobs: a data folder, or the address of a service."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from datetime import datetime
from http.client import HTTPException
from ipaddress import ip_address
from pathlib import Path
from typing import Any, cast
from urllib.error import HTTPError
from urllib.parse import quote, urlsplit
from urllib.request import OpenerDirector, ProxyHandler, Request, build_opener

import orjson

from app.jobs.job import JobState
from app.jobs.store import Store
from app.settings import Settings
from core import BenchDragonError, InvalidValue
from core.quantities import Given

# Longest wait for an answer of a service [s].
PATIENCE = 60.0
# What becomes of a finished job that is cancelled.
REMOVED = "removed"
# Fields of every status.
STATUS = {"jobID", "processID", "status", "progress", "created"}


class NoJob(BenchDragonError):
    """A job or its result does not exist, or the service refuses access."""

    code = "no-job"


class InFolder:
    """The jobs of a data folder, whether or not the service runs. raises: NoJob if a job or a result is missing"""

    def __init__(self, folder: Path) -> None:
        if not (folder / "jobs.sqlite").is_file():
            words = "--data must be a data folder of the service, got {folder} without jobs"
            raise InvalidValue.in_words("data", words, folder=str(folder))
        self.folder = folder
        with self._used():
            self.store = Store(folder)

    @contextmanager
    def _used(self) -> Iterator[None]:
        """A context in which the store is used. raises: InvalidValue if it is damaged or locked"""
        try:
            yield
        except sqlite3.Error as error:
            words = "--data {folder} cannot be used: {why}"
            raise InvalidValue.in_words("data", words, folder=str(self.folder), why=str(error)) from error

    def list(self) -> list[dict[str, Any]]:
        with self._used():
            return [job.status() for job in self.store.all()]

    def show(self, job: str) -> dict[str, Any]:
        with self._used():
            known = self.store.get(job)
        if known is None:
            raise NoJob.in_words("job", "there is no job {job} in {folder}", job=job, folder=str(self.store.folder))
        return known.status()

    def cancel(self, job: str) -> str:
        self.show(job)
        with self._used():
            if self.store.dismiss(job):
                return JobState.DISMISSED
            self.store.remove(job)
        return REMOVED

    def cancel_all(self, before: float) -> dict[str, int]:
        """Number of jobs by what became of them. before: time up to which they were created [s since 1970]"""
        with self._used():
            chosen = [job for job in self.store.all() if job.created <= before]
            ended = sum(self.store.dismiss(job.id) for job in chosen if not job.is_finished)
            finished = [job.id for job in chosen if job.is_finished]
            if finished:
                self.store.remove(*finished)
        return {JobState.DISMISSED: ended, REMOVED: len(finished)}

    def result(self, job: str) -> bytes:
        status = self.show(job)
        file = self.store.result(job)
        if status["status"] != JobState.SUCCESSFUL or not file.is_file():
            words, why = "job {job} is {status}, so it has no result: {why}", str(status["message"])
            raise NoJob.in_words("job", words, job=job, status=str(status["status"]), why=why)
        return file.read_bytes()


class OfService:
    """The jobs of a service at an address. raises: as InFolder"""

    def __init__(self, url: str, token: str) -> None:
        if not url.startswith(("http://", "https://")):
            raise InvalidValue.in_words("url", "--url must begin with http:// or https://", got=Given(url, url))
        self.url, self.token = url.rstrip("/"), token

    def _request(self, path: str, method: str = "GET") -> bytes:
        headers = {"Authorization": f"Bearer {self.token}"} if self.token else {}
        try:
            with _opener(self.url).open(
                Request(self.url + path, method=method, headers=headers), timeout=PATIENCE
            ) as answer:
                return cast(bytes, answer.read())
        except HTTPError as error:
            try:
                detail = orjson.loads(error.read())["detail"]
            except (orjson.JSONDecodeError, KeyError, TypeError):
                detail = f"{error.code} {error.reason}"
            raise NoJob.in_words("job", "{answer}", answer=str(detail)) from error
        # No connection, or a lost one; an answer that is no HTTP; an address that is none.
        except (OSError, HTTPException, ValueError) as error:
            why = str(getattr(error, "reason", error)).strip() or type(error).__name__
            raise InvalidValue.in_words("url", "--url {url} does not answer: {why}", url=self.url, why=why) from error

    def _read(self, path: str) -> dict[str, Any]:
        try:
            content = orjson.loads(self._request(path))
        except orjson.JSONDecodeError:
            content = None
        jobs = content.get("jobs", [content]) if isinstance(content, dict) else [None]
        if all(isinstance(job, dict) and job.keys() >= STATUS for job in jobs):
            return cast(dict[str, Any], content)
        raise InvalidValue.in_words("url", "--url {url} does not answer as Bench Dragon does", url=self.url)

    def list(self) -> list[dict[str, Any]]:
        return cast(list[dict[str, Any]], self._read("/jobs")["jobs"])

    def show(self, job: str) -> dict[str, Any]:
        return self._read(f"/jobs/{quote(job, safe='')}")

    def cancel(self, job: str) -> str:
        self.show(job)
        return JobState.DISMISSED if self._request(f"/jobs/{quote(job, safe='')}", "DELETE") else REMOVED

    def cancel_all(self, before: float) -> dict[str, int]:
        """As InFolder.cancel_all(); jobs that are gone meanwhile are not counted."""
        counts: dict[str, int] = {JobState.DISMISSED: 0, REMOVED: 0}
        for job in self.list():
            if datetime.fromisoformat(job["created"]).timestamp() <= before:
                with suppress(NoJob):
                    counts[self.cancel(job["jobID"])] += 1
        return counts

    def result(self, job: str) -> bytes:
        return self._request(f"/jobs/{quote(job, safe='')}/result")


def _opener(url: str) -> OpenerDirector:
    """Opens addresses through the proxy of the environment, but those of this machine itself directly."""
    host = urlsplit(url).hostname or ""
    try:
        is_here = ip_address(host).is_loopback
    except ValueError:
        is_here = host == "localhost"
    return build_opener(ProxyHandler({})) if is_here else build_opener()


def place(data: Path | None, url: str, token: str) -> InFolder | OfService:
    """The place in the options. raises: InvalidValue if they name none"""
    if url and data is not None:
        raise InvalidValue.in_words("url", "--url takes the place of --data: give one of the two")
    if url:
        return OfService(url, token)
    folder = data or Settings().data
    if folder is None:
        rule = "--data or --url must say where the jobs are, or BENCH_DRAGON_DATA in the environment"
        raise InvalidValue.in_words("data", rule)
    return InFolder(folder)
