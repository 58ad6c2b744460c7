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
# # 第二课：首次碰撞，一次也不漏
#
# 问题 2：两节板凳何时首次相碰？每秒看一次，就可能漏看。本课先看一次险些相碰，再学一种本身就是证明的时间步。

# %%
import numpy as np

from app.grade.report import typed
from core import Dance, Dragon, Spiral, clearance_profile, first_contact

dance = Dance(Dragon(), Spiral(0.55), 1.0)

# %% [markdown]
# ## 每秒看一次
#
# 间距是不共用把手的两节板凳之间的最小距离；为负时是重叠的深度。

# %%
looks = clearance_profile(dance, np.arange(405.0, 414.0))
[f"{time:.0f} s: {1000 * gap:.1f} mm" for time, gap in zip(looks.time, looks.clearance, strict=True)]

# %% [markdown]
# 409 s 和 410 s 时板凳都是分开的。那么两者之间呢？密一百倍地看：

# %%
closer = clearance_profile(dance, np.arange(409.0, 410.0, 0.01))
nearest = int(np.argmin(closer.clearance))
closer.time[nearest], 1000 * closer.clearance[nearest]

# %% [markdown]
# 不到一毫米。板凳再宽一毫米，这就是首次碰撞；而每秒看一次的人报告的是三秒以后的一次：

# %%
wider = Dance(Dragon(width=0.301), Spiral(0.55), 1.0)
true = first_contact(wider)
seen = clearance_profile(wider, np.arange(405.0, 414.0))
first_seen = float(seen.time[seen.clearance <= 0.0][0])
true.time, first_seen

# %% [markdown]
# ## 本身就是证明的时间步
#
# 若最近的一对相距 c，而任意两节板凳靠近的速度不超过 L，那么在 c / L 之内不会相碰：这就是保守推进法。下面的循环一
# 直走到间距小于一微米。再短的碰撞也不会跨过去。（龙头 1 m/s；此处把手都不快于 1.1 m/s，板凳上的点不快于约 2 m/s，
# 两节靠近至多 4 m/s：界很粗，但够用。）

# %%
time, steps = 405.0, 0
while (gap := float(clearance_profile(dance, [time]).clearance[0])) > 1e-6:
    time, steps = time + gap / 4.0, steps + 1
time, steps

# %%
contact = first_contact(dance)
contact

# %% [markdown]
# 程序库的界更好，所以整场舞只需很少的步，并给出答案所在区间：

# %%
contact.certificate.steps, contact.time_bracket, contact.benches

# %% [markdown]
# ## 练习 1
#
# 把下面的数换成你自己的答案。批改对 412.46、412.5 和论文的 406.43 各怎么说？

# %%
mine = typed("collision_time", "412.473838")
mine.verdict, mine.notes

# %%
paper = typed("collision_time", "406.43")
paper.verdict, [guess.words for guess in paper.possible]

# %% [markdown]
# ## 练习 2
#
# 不要问“现在重叠吗？”再二分：板凳会重叠、分开、再重叠。请在 405 s（没有重叠）与 425.5 s（有重叠）之间二分，批改对结果
# 怎么说？在 405 s 与 420 s 之间却碰巧成功：试过的哪个时刻起了决定作用？

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
