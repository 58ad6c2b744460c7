"""Archives: every part is as long as its directory says, stored or deflated, and ends at the limit."""

import io
import zipfile

import pytest

from app.files.archives import BadArchive, opened, pieces_of
from tests.support.bombs import lying, zipped

PARTS = {"a.txt": b"words " * 50_000, "b.txt": b""}


def unpacked(data, most=10**6):
    with opened(data, 10) as archive:
        return {part.filename: b"".join(pieces_of(archive, part, most)) for part in archive.infolist()}


def code_of(data, most=10**6):
    with pytest.raises(BadArchive) as refused:
        unpacked(data, most)
    return refused.value.code


@pytest.mark.parametrize("method", [zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED])
def test_an_honest_part_may_have_the_limit_and_no_byte_more(method):
    length = len(PARTS["a.txt"])
    assert unpacked(zipped(PARTS, method), length) == PARTS
    assert code_of(zipped(PARTS, method), length - 1) == "bomb"


@pytest.mark.parametrize("method", [zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA])
def test_methods_without_a_largest_length_are_refused(method):
    assert code_of(zipped(PARTS, method)) == "method"


@pytest.mark.parametrize("length", [100, 65_536, 299_999])
def test_a_part_that_is_longer_than_stated_is_broken(length):
    data = lying(zipped(PARTS, zipfile.ZIP_DEFLATED), "a.txt", length, PARTS["a.txt"])
    with zipfile.ZipFile(io.BytesIO(data)) as archive:  # Python unpacks all of it and shows what is stated.
        assert len(archive.read("a.txt")) == length
    assert code_of(data) == "broken"


def test_a_part_that_is_shorter_than_stated_is_broken():
    assert code_of(lying(zipped(PARTS, zipfile.ZIP_DEFLATED), "a.txt", 300_001, PARTS["a.txt"])) == "broken"


def test_parts_are_counted_before_the_directory_is_read():
    assert code_of(zipped({str(k): b"" for k in range(11)}, zipfile.ZIP_STORED)) == "parts"
    assert len(unpacked(zipped({str(k): b"" for k in range(10)}, zipfile.ZIP_STORED))) == 10


@pytest.mark.parametrize("data", [b"PK", b"PK\3\4" + bytes(40), zipped(PARTS, zipfile.ZIP_DEFLATED)[:-30]])
def test_a_part_of_an_archive_is_broken(data):
    assert code_of(data) == "broken"


def test_an_encrypted_part_is_reported():
    data = bytearray(zipped(PARTS, zipfile.ZIP_STORED))
    data[data.index(b"PK\1\2") + 8] |= 1
    assert code_of(bytes(data)) == "encrypted"
