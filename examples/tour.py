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
# # A dragon of benches
#
# On the fifteenth night of the first month, villages in Zhejiang and Fujian carry a dragon through the streets. It is
# made of wooden benches, a lantern on each, and a peg through a hole joins every bench to the next. When the head
# leads the dragon into a spiral, everyone wonders: how far in can we go before two benches touch?
#
# This notebook asks that question, and three more:
#
# 1. Where is everyone?
# 2. When do two benches first touch?
# 3. How tight may the spiral be?
# 4. How far may people stray from their places?
#
# To open it as a notebook: in the folder of the project `pip install -e '.[data,figures]' jupytext jupyterlab`, then
# `jupytext --to ipynb examples/tour.py`.

# %%
import numpy as np

from core import (
    Dance,
    Dragon,
    Spiral,
    clearance_profile,
    first_contact,
    minimum_pitch,
    pitch_scan,
    tolerance,
    trajectory,
)

# %% [markdown]
# ## The dragon, the path, the dance
#
# The dragon of the 2024 contest has 223 benches. Its head is 3.41 m long, the others 2.20 m; all are 30 cm wide, and
# the holes are 27.5 cm from the ends. A dragon of your own village has other numbers: `Dragon(benches=60, width=0.25)`,
# or `Dragon.of(lengths, widths, overhangs)` if no two benches are alike.

# %%
dragon = Dragon()
dragon

# %% [markdown]
# The spiral winds 16 times around its centre, 55 cm from one turn to the next. A dance is a dragon that follows a path,
# its head at a constant speed: here 1 m/s.

# %%
dance = Dance(dragon, Spiral(pitch=0.55), head_speed=1.0)
dance

# %% [markdown]
# ## 1. Where is everyone?
#
# Give the times, get the places. There is one more handle than there are benches: handle 0 leads, handle 223 is at the
# rear of the tail.

# %%
walk = trajectory(dance, np.arange(0.0, 301.0, 60.0))
walk

# %%
walk.plot()

# %% [markdown]
# The colours say that the tail is a little slower than the head. That surprises most people: the benches are rigid, so
# should not all handles be equally fast? Two ends of a rigid bench have the same speed *along* the bench, but on a
# curve they do not move along it. Each handle hands on a little less than it got.
#
# The numbers behind the picture are arrays, `walk.position` and `walk.speed`, or a table:

# %%
table = walk.to_dataframe()
table[table.handle.isin([0, 1, 51, 101, 151, 201, 223]) & (table.time == 300.0)]

# %% [markdown]
# ## 2. When do two benches first touch?
#
# Not neighbours, of course: they share a handle and always overlap a little there. Any other two.

# %%
contact = first_contact(dance)
contact

# %%
contact.plot()

# %% [markdown]
# It is the head that spoils it. It is longer than the other benches, so its outer front corner swings out the furthest.
# A closer look:

# %%
contact.plot(enlarged=True)

# %% [markdown]
# How sure is that? A program that looks at the dance every tenth of a second can step over a short touch. This one
# cannot: between two looks it bounds how fast any gap can change, and goes on only if no gap can close. So there are
# two instants, a fraction of a nanosecond apart: up to the first nothing touches, at the second two benches overlap.

# %%
contact.time_bracket

# %% [markdown]
# Just how close it gets before that is worth a picture. Each dot is a near miss.

# %%
profile = clearance_profile(dance, np.arange(380.0, contact.time, 0.25))
profile.plot()

# %% [markdown]
# The last near miss is less than a millimetre. Nobody can dance that. With a margin the question becomes a useful one:
# until when does everyone keep 5 cm apart?

# %%
first_contact(dance, margin=0.05)

# %% [markdown]
# ## 3. How tight may the spiral be?
#
# In the middle of the square there is a circle, 9 m across, where the dragon turns around. The head has to get there
# before two benches touch. On a wide spiral that is easy, on a tight one it is not. Somewhere in between lies the
# smallest pitch that works, and every larger one works too:

# %%
tightest = minimum_pitch(dragon, turning_radius=4.5)
tightest

# %% [markdown]
# One might look for it by drawing where the head stops on each spiral, and reading off where the curve crosses 4.5 m.
# But it never crosses. The curve is a staircase: as the spiral widens, a near miss on the way is one moment a touch,
# and the next moment it is not, and the head gets through to the next obstacle, a good way further in.

# %%
stairs = pitch_scan(dragon, np.linspace(0.43, 0.47, 9))
axes = stairs.plot()
axes.axhline(4.5, color="black", linestyle="dashed")
axes.axvline(tightest.pitch, color="black", linestyle="dotted")

# %% [markdown]
# ## 4. How far may people stray?
#
# Nobody walks on a line to the millimetre. Say that every peg may be some way off its place, this person to the left,
# that one to the right. As every bench is rigid, its ends swing out further than the people who carry it. How far may
# everyone stray so that nothing can touch, whatever they do?

# %%
stray = tolerance(dance, stop=300.0)
stray

# %% [markdown]
# The first number is proven: nobody who keeps to it can touch anything. With the second one two benches can, and the
# answer holds the pose of the whole dragon in which they do:

# %%
stray.exhibit

# %% [markdown]
# A few centimetres, with a bench on the shoulder and a lantern on the bench: that takes practice. A wider spiral is
# kinder. What would one of 80 cm allow?

# %%
wide = Dance(dragon, Spiral(pitch=0.80))
kinder = tolerance(wide, stop=300.0)
kinder

# %% [markdown]
# That is a dance for a village. From here: `check(dance, venue=...)` asks about the square and its trees, `Turn` and
# `Route` are other paths, and `import core; help(core)` lists everything else.
