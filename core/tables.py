"""Results as tables with units: a DataFrame of pandas, a Dataset of xarray. Both packages are imported on demand."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from core.display import UNITS
from core.extras import wanted

if TYPE_CHECKING:
    import pandas
    import xarray


def data_frame(what: str, columns: Mapping[str, np.ndarray[Any, Any]], units: Mapping[str, str]) -> pandas.DataFrame:
    """A table with one row for each entry of the columns.

    what: the caller, for the message; columns: (N,) each; units: of columns whose name does not imply one
    `attrs["units"]` of the result has all units.
    raises: ImportError naming the extra `data` if pandas is not installed
    """
    frame = wanted("pandas", "data", what).DataFrame(columns)
    frame.attrs["units"] = {name: units.get(name, UNITS.get(name, "")) for name in columns}
    return frame


def data_set(
    what: str, variables: Mapping[str, tuple[tuple[str, ...], Any]], coordinates: Mapping[str, Any]
) -> xarray.Dataset:
    """Arrays with named axes, each with its unit in `attrs["units"]`.

    what: the caller, for the message; variables: axes and values by name; coordinates: values by name, one axis each,
    or none for a single value
    raises: ImportError naming the extra `data` if xarray is not installed
    """
    dataset: xarray.Dataset = wanted("xarray", "data", what).Dataset(dict(variables), coords=dict(coordinates))
    for name, variable in dataset.variables.items():
        if unit := UNITS.get(str(name)):
            variable.attrs["units"] = unit
    return dataset
