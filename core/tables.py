"""Results as tables: DataFrames of pandas and Polars, a Dataset of xarray. The packages are imported on demand."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from core.display import WithArrays, meanings
from core.extras import wanted

if TYPE_CHECKING:
    import pandas
    import polars
    import xarray

# One value for each row: numbers or words, (N,).
Column: TypeAlias = np.ndarray[Any, Any]


class Table(WithArrays):
    """A result that is a table: one row for each entry of its columns."""

    __slots__ = ()

    def columns(self) -> dict[str, Column]:
        """The columns by name, (N,) each."""
        raise NotImplementedError

    def units(self) -> dict[str, str]:
        """The units of the fields by name, and those of coordinates."""
        kind: Any = type(self)
        return {"x": "m", "y": "m"} | {name: meaning.unit for name, meaning in meanings(kind).items()}

    def to_dataframe(self) -> pandas.DataFrame:
        """The columns as a DataFrame of pandas, whose `attrs["units"]` has their units.

        raises: ImportError without pandas, naming the extra
        """
        return data_frame(f"{type(self).__name__}.to_dataframe()", self.columns(), self.units())

    def to_polars(self) -> polars.DataFrame:
        """The columns as a DataFrame of Polars, which keeps no units.

        raises: ImportError without Polars, naming the extra
        """
        return polars_frame(f"{type(self).__name__}.to_polars()", self.columns())

    def to_xarray(self) -> xarray.Dataset:
        """The columns along the first one, which names the axis, each with its unit in `attrs["units"]`.

        raises: ImportError without xarray, naming the extra
        """
        (axis, values), *others = self.columns().items()
        variables = {name: ((axis,), column) for name, column in others}
        return data_set(f"{type(self).__name__}.to_xarray()", variables, {axis: values}, self.units())


def data_frame(what: str, columns: Mapping[str, Column], units: Mapping[str, str]) -> pandas.DataFrame:
    """A table of pandas with one row for each entry of the columns; `attrs["units"]` has the units of all.

    what: the caller, for the message; columns: (N,) each; units: by name, without the ending of a coordinate
    raises: ImportError naming the extra `data` if pandas is not installed
    """
    frame = wanted("pandas", "data", what).DataFrame(columns)
    frame.attrs["units"] = {name: units.get(name.removesuffix("_x").removesuffix("_y"), "") for name in columns}
    return frame


def polars_frame(what: str, columns: Mapping[str, Column]) -> polars.DataFrame:
    """A table of Polars with one row for each entry of the columns.

    what: the caller, for the message; columns: (N,) each
    raises: ImportError naming the extra `polars` if it is not installed
    """
    frame: polars.DataFrame = wanted("polars", "polars", what).DataFrame(dict(columns))
    return frame


def data_set(
    what: str,
    variables: Mapping[str, tuple[tuple[str, ...], Any]],
    coordinates: Mapping[str, Any],
    units: Mapping[str, str],
) -> xarray.Dataset:
    """Arrays with named axes, each with its unit in `attrs["units"]`.

    what: the caller, for the message; variables: axes and values by name; coordinates: values by name, one axis each,
    or none for a single value; units: by name
    raises: ImportError naming the extra `data` if xarray is not installed
    """
    dataset: xarray.Dataset = wanted("xarray", "data", what).Dataset(dict(variables), coords=dict(coordinates))
    for name, variable in dataset.variables.items():
        if unit := units.get(str(name)):
            variable.attrs["units"] = unit
    return dataset
