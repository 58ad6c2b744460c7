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
# 程序库的结果与此相同，直到第十一位：

# %%
dance = Dance(Dragon(), Spiral(0.55), 1.0)
exact = trajectory(dance, 300.0)
apart = np.abs(exact.position - places).max()
apart

# %% [markdown]
# ## 速度
#
# 板凳是刚性的：两端*沿板凳方向*的分速度相等。设 u 为板凳方向，T 为把手处路径的切向，则 v₁ (T₁ · u) = v₀ (T₀ · u)。
# 这是精确的；位置差除以小时间步则不是，步长再小也没有用：步长越小，舍入误差越大。

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
# ## 练习 1
#
# 批改程序也读表格。下面是一名学生的表格，他把板长 2.20 m 当作两孔间距。批改怎么说？再换成你自己的表格：`name` 与
# `data` 为你的文件名和内容。

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
# ## 练习 2
#
# 300 s 时哪个把手最慢，为什么是最后一个？螺距变大时有什么变化？（`np.argmin(speeds)` 回答第一问。）

# %%
int(np.argmin(speeds))
