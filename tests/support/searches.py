"""The search of contacts, whose arrays the tests of the loops lay out."""

from core.contact.search import ContactSearch, SearchInput


def search_on(dragon, path, margin=0.0, *, budget=None, **more):
    """The search of a dragon on a path. more: fields of its input"""
    return ContactSearch(SearchInput(dragon, path, margin, **more), budget=budget)
