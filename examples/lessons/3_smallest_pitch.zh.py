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
# # 第三课：最小螺距，以及为什么不能对半径二分
#
# 问题 3：龙头要不碰撞地到达直径 9 m 的圆，螺距最小是多少？许多论文对螺距二分，直到龙头停在 4.5 m 处。这样的螺距并
# 不存在。

# %%
import numpy as np

from app.grade.report import typed
from core import Dance, Dragon, Spiral, clearance_profile, first_contacts, minimum_pitch

# %% [markdown]
# ## 龙头停在哪里
#
# 对每个螺距，舞蹈在首次碰撞时终止，此时龙头在某个半径处。一次算六十场舞，用上所有核：

# %%
pitches = np.linspace(0.44, 0.46, 60)
found = first_contacts([Dance(Dragon(), Spiral(pitch)) for pitch in pitches])
radii = np.array([contact.head.radius for contact in found])
falls = np.abs(np.diff(radii))
worst = int(np.argmax(falls))
pitches[worst : worst + 2], radii[worst : worst + 2]

# %% [markdown]
# 半径是跳跃式减小的：螺距大一点点，刚才恰好相碰的角就恰好通过，下一次碰撞要晚得多。现在对螺距二分，使半径为 4.5 m：


# %%
def radius(pitch):
    return first_contacts([Dance(Dragon(), Spiral(pitch))])[0].head.radius


low, high = 0.44, 0.46
while high - low > 1e-9:
    middle = (low + high) / 2
    low, high = (middle, high) if radius(middle) > 4.5 else (low, middle)
low, radius(low), high, radius(high)

# %% [markdown]
# 区间只有十亿分之一米宽，两端却使龙头停在相差 17 cm 的两处，分别在 4.5 m 两侧。若要一直算到半径等于 4.5 m，就永远
# 停不下来；若在区间很窄时停下，找到的是一个跳跃，而方法本身既不说明它是不是对的那个，也不说明更大的螺距是否都可行。

# %% [markdown]
# ## 正确的提法
#
# 求解一个连续的量：到达圆之前全程的最小间距（作为螺距的函数）等于零。并且证明更大的螺距都可行。

# %%
smallest = minimum_pitch(Dragon(), turning_radius=4.5)
smallest

# %%
smallest.limited_by, smallest.benches, round(smallest.head_radius, 3), smallest.proven_up_to

# %% [markdown]
# 限制来自*途中*第 0 节与第 19 节的一次擦碰，此时龙头还在 4.57 m 处。只检查龙头在圆上那一刻的人会得到 0.42 m，以及
# 一次碰撞。

# %% [markdown]
# ## 练习 1
#
# 批改对下面这些数怎么说，对你的呢？注意舍入：最小螺距应向哪边舍入？

# %%
verdicts = {text: typed("pitch", text).verdict for text in ("0.450338", "0.450337", "0.4503", "0.4202169", "0.43")}
verdicts

# %%
[finding.words for finding in typed("pitch", "0.4202169").diagnosis]

# %% [markdown]
# ## 练习 2
#
# 每秒只看一次途中情况的人会漏掉那次擦碰。请求出这样看来没有碰撞的最小螺距并交给批改：它怎么说？看得密十倍呢？再把圆改小
# 为 8 m，或让龙头与其余板凳一样长（`Dragon(head_length=2.2)`）：答案的变化合乎预料吗？


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
