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
# # 第一课：位置与速度
#
# 赛题（全国大学生数学建模竞赛 2024 A）问题 1：223 节板凳组成的板凳龙沿螺线盘入，龙头速度 1 m/s。每一秒各把手在哪
# 里、速度多大？
#
# 本课用十行 NumPy 自己摆放各把手，不用任何时间差分求出速度，再由批改程序评判。

# %%
import numpy as np

from app.grade.report import graded
from core import Budget, Dance, Dragon, Spiral, trajectory

# %% [markdown]
# ## 龙头
#
# 在螺线 r = b θ（b = 螺距 / 2π）上，从中心起的弧长为 s(θ) = b/2 (θ √(1 + θ²) + asinh θ)。龙头从 θ = 32π 出发，t
# 秒后走了 t 米，所以它的 θ 满足 s(θ) = s(32π) − t。因为 s' = b √(1 + θ²)，牛顿法几步就够。

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
# ## 下一个把手
#
# 下一个把手是沿螺线向后、与前一把手相距两孔间距的*第一个*点：龙头为 3.41 − 2 · 0.275 = 2.86 m，其余板凳为 1.65 m。
# 不是板长！设两者的极角差为 δ，由余弦定理得到的方程左边在 0 到 π 上单调增加，所以二分法找到的是第一个交点，不会跳
# 到别的圈上。


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
# 程序库的结果与此相同，直到第十一位：

# %%
dance = Dance(Dragon(), Spiral(0.55), 1.0)
exact = trajectory(dance, 300.0)
apart = np.abs(exact.position - places_of(mine)).max()
apart

# %% [markdown]
# ## 速度
#
# 板凳是刚性的：两端*沿板凳方向*的分速度相等。设 u 为板凳方向，T 为把手处路径的切向，则 v₁ (T₁ · u) = v₀ (T₀ · u)。
# 这是精确的；位置差除以小时间步则不是，步长再小也没有用：步长越小，舍入误差越大。


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
# ## 练习 1
#
# 批改程序也读表格。请写出你自己的表格，共 301 秒：上面的函数可以一次算许多时刻。再写出一名学生的表格，他把板长 2.20 m
# 当作两孔间距。批改怎么说？再故意在你的表格里犯一个错，看它能否被找到。

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
# ## 练习 2
#
# 现在改用差分求速度：用一秒之内走过的距离。批改看得出来吗？步长取 0.001 s 有帮助吗？300 s 时哪个把手最慢，为什么是
# 最后一个？（`np.argmin(speeds)` 回答前一问。）

# %%
a_second_later = places_of(handles(times + 1.0))
differences = judged(places_of(all_mine), np.linalg.norm(a_second_later - places_of(all_mine), axis=-1))
differences

# %%
int(np.argmin(speeds))
