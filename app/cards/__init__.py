"""Cue cards: what the carriers of each bench have to know, in words, as a table and on paper."""
