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
# # Lesson 3: the smallest pitch, and why halving a radius fails
#
# Question 3: the head must reach a circle of 9 m without any touch. What is the smallest pitch of the spiral? Many
# papers halve the pitch until the head stops at 4.5 m. There is no such pitch.

# %%
import numpy as np

from app.grade.report import typed
from core import Dance, Dragon, Spiral, clearance_profile, first_contacts, minimum_pitch

# %% [markdown]
# ## Where the head stops
#
# For each pitch the dance ends at its first contact, and the head is then at some radius. Sixty dances at once, on
# all cores:

# %%
pitches = np.linspace(0.44, 0.46, 60)
found = first_contacts([Dance(Dragon(), Spiral(pitch)) for pitch in pitches])
radii = np.array([contact.head.radius for contact in found])
falls = np.abs(np.diff(radii))
worst = int(np.argmax(falls))
pitches[worst : worst + 2], radii[worst : worst + 2]

# %% [markdown]
# The radius falls in jumps: a hair more pitch, and a corner just passes where it just touched; the next contact comes
# much later. Now halve the pitch for a radius of 4.5 m:


# %%
def radius(pitch):
    return first_contacts([Dance(Dragon(), Spiral(pitch))])[0].head.radius


low, high = 0.44, 0.46
while high - low > 1e-9:
    middle = (low + high) / 2
    low, high = (middle, high) if radius(middle) > 4.5 else (low, middle)
low, radius(low), high, radius(high)

# %% [markdown]
# The interval is a billionth of a metre wide, and its two ends stop the head 17 cm apart, on both sides of 4.5 m.
# Whoever goes on until the radius is 4.5 m goes on for ever. Whoever stops at a narrow interval has found a jump, and
# nothing in the method says whether it is the right one, nor whether every larger pitch works.

# %% [markdown]
# ## The right question
#
# Solve for something that is continuous: the least clearance on the whole way to the circle, as a function of the
# pitch, equals zero. And prove that every larger pitch works too.

# %%
smallest = minimum_pitch(Dragon(), turning_radius=4.5)
smallest

# %%
smallest.limited_by, smallest.benches, round(smallest.head_radius, 3), smallest.proven_up_to

# %% [markdown]
# The limit is a graze of benches 0 and 19 *on the way*, with the head still 4.57 m out. Whoever checks only the pose
# on the circle gets 0.42 m, and a collision.

# %% [markdown]
# ## Exercise 1
#
# What does the grader say of these, and of yours? Mind the rounding: which way must a smallest pitch be rounded?

# %%
verdicts = {text: typed("pitch", text).verdict for text in ("0.450338", "0.450337", "0.4503", "0.4202169", "0.43")}
verdicts

# %%
[finding.words for finding in typed("pitch", "0.4202169").diagnosis]

# %% [markdown]
# ## Exercise 2
#
# Whoever looks at the way once a second misses the graze. Find the smallest pitch that looks clear so, and hand it in:
# what does the grader say, and what of looks ten times as often? Then make the circle smaller, 8 m, or the head as
# short as the others, `Dragon(head_length=2.2)`: does the answer change as you expect?


# %%
def looks_clear(pitch, step):
    b = pitch / (2 * np.pi)
    start, circle = (b / 2 * (at * np.sqrt(1 + at**2) + np.arcsinh(at)) for at in (32 * np.pi, 4.5 / b))
    times = np.arange(0.0, start - circle, step)
    return clearance_profile(Dance(Dragon(), Spiral(pitch)), times).clearance.min() > 0.0


least, most = 0.44, 0.46
while most - least > 1e-8:
    middle = (least + most) / 2
    least, most = (least, middle) if looks_clear(middle, 1.0) else (middle, most)
looked = typed("pitch", f"{most:.7f}")
most, looked.verdict, [guess.words for guess in looked.possible]

# %%
minimum_pitch(Dragon(), turning_radius=4.0).pitch, minimum_pitch(Dragon(head_length=2.2), turning_radius=4.5).pitch
