"""First contacts of many dances at once."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial

from core.checks import checked_list, checked_type
from core.contact.answer import FirstContact
from core.contact.first_contact import first_contact
from core.dance import Dance
from core.display import Answers
from core.dragon import Stray
from core.kernels import Budget
from core.threads import on_all_cores


def first_contacts(
    dances: Iterable[Dance],
    *,
    margin: float = 0.0,
    stray: float | Stray = 0.0,
    start: float | None = None,
    stop: float | None = None,
    budget: Budget | None = None,
) -> list[FirstContact]:
    """First contacts of many dances, each as first_contact() answers it alone, to the last digit, but on all cores.

    margin, stray, start, stop: of every one of them, see first_contact()
    budget: of all together
    returns: one for each dance, in their order; a notebook shows a table
    raises: as first_contact(), for the first of the dances for which it does

    >>> from core import Dragon, Spiral
    >>> found = first_contacts(Dance(Dragon(), Spiral(pitch)) for pitch in (0.5, 0.55, 0.6))
    >>> [round(contact.time, 2) for contact in found]
    [336.53, 412.47, 466.51]
    """
    every = checked_list("dances", dances, "must be a list of Dance objects")
    for k, dance in enumerate(every):
        checked_type(f"dances.{k}", dance, Dance)
    if budget is not None:
        checked_type("budget", budget, Budget)
    question = partial(first_contact, margin=margin, stray=stray, start=start, stop=stop, budget=budget)
    return Answers(on_all_cores(question, every))
