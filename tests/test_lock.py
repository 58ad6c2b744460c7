"""The locked versions can be installed on every machine that README names, without a compiler."""

import re
import sys

import pytest

from tests.conftest import OUTER
from tests.support.lock import PROCESSORS, PYTHONS, ROOT, resolved, run_with_index

pytestmark = [pytest.mark.uncompiled, pytest.mark.index, pytest.mark.thorough]

# What make serve and make test install; of the engines some machines lack some.
LOCKS = ("requirements.lock", "requirements-test.lock")


@pytest.mark.parametrize("processor", PROCESSORS)
@pytest.mark.parametrize("python", PYTHONS)
def test_there_is_a_wheel_of_every_locked_version(python, processor):
    done = resolved([word for name in LOCKS for word in ("-r", str(ROOT / name))], python, processor, OUTER)
    assert done.returncode == 0, done.stderr


def test_a_version_without_a_wheel_is_noticed():
    done = resolved(["-r", str(ROOT / "requirements-ccd.lock")], "3.14", "aarch64", OUTER)
    assert done.returncode != 0
    assert "no wheels" in done.stderr


def test_a_file_whose_digest_is_another_is_refused(tmp_path):
    text = (ROOT / "requirements.hashes").read_text(encoding="utf-8")
    package = re.search(r"^idna==.*(\n .*)+", text, re.MULTILINE)
    assert package is not None
    assert downloaded(package[0], tmp_path).returncode == 0
    other = downloaded(re.sub(r":\w{8}", ":00000000", package[0]), tmp_path)
    assert other.returncode != 0
    assert "DO NOT MATCH THE HASHES" in other.stderr


def downloaded(requirements, folder):
    (folder / "file.txt").write_text(requirements + "\n", encoding="utf-8")
    command = [sys.executable, "-m", "pip", "download", "--require-hashes", "--no-deps", "-r", "file.txt"]
    return run_with_index(command, OUTER, folder)
