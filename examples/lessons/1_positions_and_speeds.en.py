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
# # Lesson 1: positions and speeds
#
# Question 1 of the contest (CUMCM 2024 A): a dragon of 223 benches winds into a spiral, its head at 1 m/s. Where is
# every handle in every second, and how fast is it?
#
# You will place the handles yourself with ten lines of NumPy, find the speeds without a single difference in time,
# and let the grader judge both.

# %%
import numpy as np

from app.grade.report import graded
from core import Budget, Dance, Dragon, Spiral, trajectory

# %% [markdown]
# ## The head
#
# On the spiral r = b θ with b = pitch / 2π the length of the arc from the centre is s(θ) = b/2 (θ √(1 + θ²) + asinh
# θ). The head starts at θ = 32π and has walked t metres after t seconds, so its θ solves s(θ) = s(32π) − t. Newton's
# method needs few steps, because s' = b √(1 + θ²).

# %%
b = 0.55 / (2 * np.pi)


def arc(theta):
    return b / 2 * (theta * np.sqrt(1 + theta**2) + np.arcsinh(theta))


def head_at(time):
    theta, goal = 32 * np.pi, arc(32 * np.pi) - time
    for _ in range(20):
        theta -= (arc(theta) - goal) / (b * np.sqrt(1 + theta**2))
    return theta


head_at(300.0)

# %% [markdown]
# ## The next handle
#
# The next handle is the *first* place behind, along the spiral, at the distance of the two holes: 3.41 − 2 · 0.275 =
# 2.86 m for the head, 1.65 m for every other bench. Not the length of the bench! With δ the angle between both, the
# law of cosines gives an equation whose left side only grows from 0 to π, so halving the interval finds the first
# meeting and never jumps to another ring.


# %%
def behind(theta, chord):
    low, high = 0.0 * theta, np.pi + 0.0 * theta
    for _ in range(60):
        delta = (low + high) / 2
        near = delta**2 + 4 * theta * (theta + delta) * np.sin(delta / 2) ** 2 < (chord / b) ** 2
        low, high = np.where(near, delta, low), np.where(near, high, delta)
    return theta + low


def handles(time):
    thetas = [head_at(time)]
    for chord in [2.86] + 222 * [1.65]:
        thetas.append(behind(thetas[-1], chord))
    return np.array(thetas)


def places_of(mine):
    return b * mine[..., None] * np.stack([np.cos(mine), np.sin(mine)], axis=-1)


mine = handles(300.0)
places_of(mine)[[0, -1]].round(6)

# %% [markdown]
# The library has the same to eleven digits:

# %%
dance = Dance(Dragon(), Spiral(0.55), 1.0)
exact = trajectory(dance, 300.0)
apart = np.abs(exact.position - places_of(mine)).max()
apart

# %% [markdown]
# ## Speeds
#
# A bench is rigid: its two ends are equally fast *along the bench*. With u the direction of the bench and T the
# direction of the path at a handle, v₁ (T₁ · u) = v₀ (T₀ · u). That is exact. A difference of two positions over a
# small time is not, and a smaller step does not help for long: rounding grows as the step shrinks.


# %%
def speeds_of(mine):
    along = np.stack([np.sin(mine) * mine - np.cos(mine), -np.cos(mine) * mine - np.sin(mine)], axis=-1)
    along /= np.linalg.norm(along, axis=-1, keepdims=True)
    places = places_of(mine)
    speeds = [1.0 + 0.0 * mine[0]]
    for k, u in enumerate(places[:-1] - places[1:]):
        speeds.append(speeds[-1] * (along[k] * u).sum(axis=-1) / (along[k + 1] * u).sum(axis=-1))
    return np.array(speeds)


speeds = speeds_of(mine)
furthest = np.abs(exact.speed - speeds).max()
furthest

# %%
earlier, later = handles(300.0 - 1e-3)[-1], handles(300.0 + 1e-3)[-1]
differenced = abs(arc(earlier) - arc(later)) / 2e-3
abs(differenced - speeds[-1])

# %% [markdown]
# ## Exercise 1
#
# The grader reads tables too. Write yours, of all 301 seconds: the functions above take many times at once. Then that
# of a student who took the length of a bench, 2.20 m, for the distance of its holes. What does the grader say? Spoil
# your own by an error of your choice, and see whether it is found.

# %%
names = ["龙头"] + [f"第{k}节龙身" for k in range(1, 222)] + ["龙尾", "龙尾（后）"]


def table(places, speeds):
    """The table of a workbook. places: (224, 301, 2) [m]; speeds: (224, 301) [m/s]"""
    rows = ["," + ",".join(f"{time} s" for time in range(301))]
    for k, name in enumerate(names):
        for label, values in (("x (m)", places[k, :, 0]), ("y (m)", places[k, :, 1]), ("速度 (m/s)", speeds[k])):
            rows.append(f"{name}{label}," + ",".join(f"{value:.6f}" for value in values))
    return "\n".join(rows).encode()


def judged(places, speeds):
    grade = graded("result1.csv", table(places, speeds), Budget())
    return grade.verdict, [finding.words for finding in grade.diagnosis]


times = np.arange(301.0)
all_mine = handles(times)
own = judged(places_of(all_mine), speeds_of(all_mine))
own

# %%
wrong = trajectory(Dance(Dragon(overhang=0.0), Spiral(0.55)), times)
long_benches = judged(wrong.position.swapaxes(0, 1), wrong.speed.T)
long_benches

# %% [markdown]
# ## Exercise 2
#
# Now take the speeds from differences: the way from one second to the next. Does the grader see it, and does a step of
# 0.001 s help? Which handle is the slowest at 300 s, and why is it the last one? (`np.argmin(speeds)` answers the
# first part.)

# %%
a_second_later = places_of(handles(times + 1.0))
differences = judged(places_of(all_mine), np.linalg.norm(a_second_later - places_of(all_mine), axis=-1))
differences

# %%
int(np.argmin(speeds))
