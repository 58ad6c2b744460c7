"""Widths of brackets, the error of travels, and the last part before a fold, as every march has them."""

from __future__ import annotations

from core.kernels import Ended

# Half width of the bracket around a contact [m of head travel] at head speeds of 1 m/s and more, and the least half
# width that rounding of the travel allows at lower speeds.
BRACKET = 1e-10
BRACKET_MIN = 2e-11
# Wider half widths [m of head travel] to try for contacts within about 5e-5 m of a graze, where benches meet so slowly
# that rounding hides the gap. The first gives a bracket of 1e-9 s at 1 m/s, to which core/contact/near_graze.py narrows
# the wider ones. Below 1 m/s the same numbers in seconds come first.
BRACKETS_GRAZING = (4.9e-10, 5e-9, 5e-8, 5e-7, 5e-6, 5e-5)
# Largest relative error of a travel [1], u = 2^-53: 2 u for two differences from the length of a spiral, whose own
# rounding and the polar angle there are known in double-double, and 2 u for a travel that becomes a time and a travel
# again; where a place comes from a spiral_arc() in doubles, as in Search.travel_at(), 9 u.
TRAVEL_ROUNDING = 2e-15
# Length of the last part before a fold that only the bound on the remaining motion covers [m].
FOLD_SLIVER = 1e-9
# Distances before the fold at which the march may end, as shares of the chord of the bench that folds [1]. At the first
# one the bound is enough for pitches from 0.66 to 2 m, after half of the steps; at the second one also with a fifth of
# that clearance. (With 1e-3 as the first one it is enough from 0.75 m on, and 0.66 to 0.74 m take 2.7 instead of 2.1
# times as long as a contact; measured 2026-11-22.)
FOLD_WAYS = (3e-4, 3e-5)
# Ends of a march at a contact.
TOUCHES = (Ended.TOUCHED, Ended.TOUCHED_AT_START)
