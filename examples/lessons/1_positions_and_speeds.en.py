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
    low, high = 0.0, np.pi
    for _ in range(60):
        delta = (low + high) / 2
        apart = delta**2 + 4 * theta * (theta + delta) * np.sin(delta / 2) ** 2
        low, high = (delta, high) if apart < (chord / b) ** 2 else (low, delta)
    return theta + low


def handles(time):
    thetas = [head_at(time)]
    for chord in [2.86] + 222 * [1.65]:
        thetas.append(behind(thetas[-1], chord))
    return np.array(thetas)


mine = handles(300.0)
places = b * mine[:, None] * np.stack([np.cos(mine), np.sin(mine)], axis=1)
places[[0, -1]].round(6)

# %% [markdown]
# The library has the same to eleven digits:

# %%
dance = Dance(Dragon(), Spiral(0.55), 1.0)
exact = trajectory(dance, 300.0)
apart = np.abs(exact.position - places).max()
apart

# %% [markdown]
# ## Speeds
#
# A bench is rigid: its two ends are equally fast *along the bench*. With u the direction of the bench and T the
# direction of the path at a handle, v₁ (T₁ · u) = v₀ (T₀ · u). That is exact. A difference of two positions over a
# small time is not, and a smaller step does not help for long: rounding grows as the step shrinks.

# %%
along = np.stack([np.sin(mine) * mine - np.cos(mine), -np.cos(mine) * mine - np.sin(mine)], axis=1)
along /= np.linalg.norm(along, axis=1, keepdims=True)
bench = places[:-1] - places[1:]
speeds = [1.0]
for k, u in enumerate(bench):
    speeds.append(speeds[-1] * (along[k] @ u) / (along[k + 1] @ u))
slowest = np.abs(exact.speed - speeds).max()
slowest

# %%
earlier, later = handles(300.0 - 1e-3)[-1], handles(300.0 + 1e-3)[-1]
differenced = abs(arc(earlier) - arc(later)) / 2e-3
abs(differenced - speeds[-1])

# %% [markdown]
# ## Exercise 1
#
# The grader reads tables too. Here is one of a student who took the length of a bench, 2.20 m, for the distance of
# its holes. What does it say? Then write the table of your own handles, with `name` and `data` of a file that you
# made.

# %%
wrong = trajectory(Dance(Dragon(overhang=0.0), Spiral(0.55)), np.arange(301.0))
rows = ["," + ",".join(f"{time:g} s" for time in wrong.time)]
for k in range(224):
    name = "龙头" if k == 0 else "龙尾（后）" if k == 223 else "龙尾" if k == 222 else f"第{k}节龙身"
    for axis, label in enumerate("xy"):
        rows.append(f"{name}{label} (m)," + ",".join(f"{value:.6f}" for value in wrong.position[:, k, axis]))
name, data = "result1.csv", "\n".join(rows).encode()
grade = graded(name, data, Budget())
grade.verdict, [finding.error for finding in grade.diagnosis]

# %% [markdown]
# ## Exercise 2
#
# The head passes the place where the bench that follows is slowest. Which handle is the slowest at 300 s, and why is
# it the last one? What changes with a larger pitch? (`np.argmin(speeds)` answers the first part.)

# %%
int(np.argmin(speeds))
