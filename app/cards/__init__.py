"""Cue cards and the crew: what carriers have to know, and who carries when, in words, as a table and on paper."""
