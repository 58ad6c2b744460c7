"""Results as tables: DataFrames of pandas and Polars, a Dataset of xarray. The packages are imported on demand."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from core.display import NO_MEANING, ROWS_MOST, WithArrays, display, meanings, table_rows
from core.extras import wanted
from core.language import say

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

    def _body(self) -> str:
        """The first rows with units in their head, below the fields that are no arrays."""
        columns, units = self.columns(), self.units()
        heads = [(name.replace("_", " "), unit_of(name, units)) for name in columns]
        rows = [*zip(*(column[:ROWS_MOST].tolist() for column in columns.values()), strict=True)]
        texts = [[say(value) if isinstance(value, str) else display(value) for value in row] for row in rows]
        return table_rows(heads, texts, len(next(iter(columns.values()))))

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
        """The columns along the first one, which names the axis: each has its meaning in `attrs["long_name"]` and
        its unit in `attrs["units"]`, "1" for counts; `attrs` of all says what it is, and what made it.

        raises: ImportError without xarray, naming the extra
        """
        (axis, values), *others = self.columns().items()
        return self._data_set({name: ((axis,), column) for name, column in others}, {axis: values})

    def _data_set(
        self, variables: Mapping[str, tuple[tuple[str, ...], Any]], coordinates: Mapping[str, Any]
    ) -> xarray.Dataset:
        """Arrays with named axes, as to_xarray() says.

        variables: axes and values by name; coordinates: values by name, one axis each, or none for a single value
        raises: ImportError naming the extra `data` if xarray is not installed
        """
        from importlib.metadata import version

        kind: Any = type(self)
        package = wanted("xarray", "data", f"{kind.__name__}.to_xarray()")
        dance = {"dance": repr(of)} if (of := getattr(self, "dance", None)) else {}
        attributes = {"title": repr(self).strip("<>"), "source": f"Bench Dragon {version('bench-dragon')}", **dance}
        dataset: xarray.Dataset = package.Dataset(dict(variables), dict(coordinates), attributes)
        for name, variable in dataset.variables.items():
            meaning = meanings(kind).get(str(name), NO_MEANING)
            variable.attrs["long_name"] = meaning.words or str(name).replace("_", " ")
            if variable.dtype.kind in "fi":
                variable.attrs["units"] = meaning.unit or "1"
        return dataset


def data_frame(what: str, columns: Mapping[str, Column], units: Mapping[str, str]) -> pandas.DataFrame:
    """A table of pandas with one row for each entry of the columns; `attrs["units"]` has the units of all.

    what: the caller, for the message; columns: (N,) each; units: by name, without the ending of a coordinate
    raises: ImportError naming the extra `data` if pandas is not installed
    """
    frame = wanted("pandas", "data", what).DataFrame(columns)
    frame.attrs["units"] = {name: unit_of(name, units) for name in columns}
    return frame


def unit_of(column: str, units: Mapping[str, str]) -> str:
    """The unit of a column, whose name may end with that of a coordinate; empty for what is no quantity."""
    return units.get(column.removesuffix("_x").removesuffix("_y"), "")


def polars_frame(what: str, columns: Mapping[str, Column]) -> polars.DataFrame:
    """A table of Polars with one row for each entry of the columns.

    what: the caller, for the message; columns: (N,) each
    raises: ImportError naming the extra `polars` if it is not installed
    """
    frame: polars.DataFrame = wanted("polars", "polars", what).DataFrame(dict(columns))
    return frame
