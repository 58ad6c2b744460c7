"""Optional packages: asked for by name where they are missing, never imported before."""

import sys

import pytest

from core import Dance, Dragon, Spiral, clearance_profile, first_contact, trajectory
from core.extras import wanted

DANCE = Dance(Dragon(5), Spiral())
TRAJECTORY = trajectory(DANCE, 0.0)
PROFILE = clearance_profile(DANCE, 0.0)
CONTACT = first_contact(DANCE)


@pytest.mark.parametrize(
    "package, extra, ask",
    [
        ("pandas", "data", TRAJECTORY.to_dataframe),
        ("polars", "polars", TRAJECTORY.to_polars),
        ("xarray", "data", PROFILE.to_xarray),
        ("matplotlib", "figures", CONTACT.plot),
    ],
)
def test_a_missing_package_is_named_with_the_extra_that_brings_it(package, extra, ask, monkeypatch):
    # None in sys.modules is Python's own word for a module that cannot be imported.
    for name in [name for name in sys.modules if name.partition(".")[0] == package]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, package, None)
    words = rf"needs the package {package}, which is not installed: pip install 'bench-dragon\[{extra}\]'"
    with pytest.raises(ImportError, match=words):
        ask()


def test_a_package_that_lacks_something_itself_says_so(tmp_path, monkeypatch):
    (tmp_path / "half_a_package.py").write_text("import something_else_that_is_missing")
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(ModuleNotFoundError, match="something_else_that_is_missing"):
        wanted("half_a_package", "data", "this test")
