# ---
# jupyter:
#   jupytext:
#     text_representation:
#       extension: .py
#       format_name: percent
#   kernelspec:
#     display_name: Python 3
#     language: python
#     name: python3
# ---

# %% [markdown]
# # Lesson 2: first contact, without missing one
#
# Question 2: when do two benches first touch? Whoever looks once a second may look past a touch. You will see one
# that is only just not there, and learn a step that is a proof.

# %%
import numpy as np

from app.grade.report import typed
from core import Dance, Dragon, Spiral, clearance_profile, first_contact

dance = Dance(Dragon(), Spiral(0.55), 1.0)

# %% [markdown]
# ## Look once a second
#
# The clearance is the smallest distance between two benches that share no handle; negative, the depth of an overlap.

# %%
looks = clearance_profile(dance, np.arange(405.0, 414.0))
[f"{time:.0f} s: {1000 * gap:.1f} mm" for time, gap in zip(looks.time, looks.clearance, strict=True)]

# %% [markdown]
# At 409 s and at 410 s the benches are apart. And in between? Look a hundred times as often:

# %%
closer = clearance_profile(dance, np.arange(409.0, 410.0, 0.01))
nearest = int(np.argmin(closer.clearance))
closer.time[nearest], 1000 * closer.clearance[nearest]

# %% [markdown]
# Less than a millimetre. With benches one millimetre wider that would have been the first contact, and whoever looks
# once a second tells of one three seconds later:

# %%
wider = Dance(Dragon(width=0.301), Spiral(0.55), 1.0)
true = first_contact(wider)
seen = clearance_profile(wider, np.arange(405.0, 414.0))
first_seen = float(seen.time[seen.clearance <= 0.0][0])
true.time, first_seen

# %% [markdown]
# ## A step that is a proof
#
# If the nearest pair is c apart and no two benches close in faster than L, nothing touches for c / L: that is
# conservative advancement. The loop below goes on so until the gap is below a micrometre. It never steps over a
# touch, however short. (A head at 1 m/s; no handle here is faster than 1.1 m/s, so no point of a bench is faster than
# some 2 m/s, and two close in at 4 m/s at most: a crude bound, and it is enough.)

# %%
time, steps = 405.0, 0
while (gap := float(clearance_profile(dance, [time]).clearance[0])) > 1e-6:
    time, steps = time + gap / 4.0, steps + 1
time, steps

# %%
contact = first_contact(dance)
contact

# %% [markdown]
# The library knows better bounds, so it needs few steps for the whole dance, and it says how wide the bracket of its
# answer is:

# %%
contact.certificate.steps, contact.time_bracket, contact.benches

# %% [markdown]
# ## Exercise 1
#
# Type your own answer in place of this one. What does the grader say of 412.46, of 412.5, of 406.43, which the paper
# has?

# %%
mine = typed("collision_time", "412.473838")
mine.verdict, mine.notes

# %%
paper = typed("collision_time", "406.43")
paper.verdict, [guess.words for guess in paper.possible]

# %% [markdown]
# ## Exercise 2
#
# Never ask “do they overlap now?” and halve the interval: benches overlap, come apart and overlap again. Halve between
# 405 s, where nothing overlaps, and 425.5 s, where benches do. What does the grader say of what comes out? Between
# 405 s and 420 s it goes well, by luck: which of the times that are tried decides?

# %%
low, high = 405.0, 425.5
while high - low > 1e-7:
    middle = (low + high) / 2
    overlap = clearance_profile(dance, [middle]).clearance[0] <= 0.0
    low, high = (low, middle) if overlap else (middle, high)
halved = typed("collision_time", f"{high:.6f}")
halved.verdict, halved.notes

# %%
after = clearance_profile(dance, np.arange(412.0, 416.0, 0.005))
clear_again = after.time[(after.clearance > 0.0) & (after.time > 413.0)]
clear_again[[0, -1]]
