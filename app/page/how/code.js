/** The lines of Python that compute what a figure shows, by the id of its section: functions of its numbers. */

/** @type {Record<string, (values: any) => string>} */
export const CODE = {
  chord: ({ chord, turns }) => `from core import Dance, Dragon, Spiral, trajectory

dragon = Dragon(benches=11, head_length=${(chord + 0.55).toFixed(2)})
now = trajectory(Dance(dragon, Spiral(0.55, ${turns})), 0.0)
print(now.position[1], now.speed[1])`,
  staircase: ({ pitch }) => `from core import Dance, Dragon, Spiral, first_contact, minimum_pitch

contact = first_contact(Dance(Dragon(), Spiral(${pitch})))
print(contact.benches, contact.head.radius)
print(minimum_pitch(Dragon(), turning_radius=4.5).pitch)`,
  step: ({ time, length }) => `from core import Dance, Dragon, Spiral, clearance_profile, first_contact

dance = Dance(Dragon(benches=40), Spiral(0.55))
start, stop = ${time}, ${(time + length).toFixed(2)}
print(clearance_profile(dance, [start, stop]).clearance)
proof = first_contact(dance, start=start, stop=stop)
print(proof.outcome, proof.certificate.steps, proof.certificate.bound)`,
  graze: ({ step, pitch }) => `import numpy as np

from core import Dance, Dragon, Spiral, clearance_profile, first_contact

dance = Dance(Dragon(benches=40), Spiral(${pitch}))
looks = clearance_profile(dance, np.arange(211.0, 221.01, ${step}))
print((looks.clearance < 0.0).sum(), "of", looks.time.size, "looks see an overlap")
print(first_contact(dance).time)`,
  stray: ({ stray, pitch }) => `from core import Dance, Dragon, Spiral, first_contact, tolerance_curve

spiral = Spiral(${pitch})
print(tolerance_curve(Dragon(), [${pitch}]).stray)
print(first_contact(Dance(Dragon(), spiral), stray=${(stray / 100).toFixed(3)}, stop=spiral.travel_to(4.5)))`,
  proof: ({ step, width }) => `import numpy as np

from core import Dance, Dragon, Spiral, clearance_profile, first_contact

dance = Dance(Dragon(benches=40, width=${(width / 100).toFixed(4)}), Spiral(0.55))
looks = clearance_profile(dance, np.arange(405.5, 411.51, ${step}))
print("looks see a gap of", 1000 * looks.clearance.min(), "mm at least")
proof = first_contact(dance, start=405.5, stop=411.5)
print(proof.outcome, proof.certificate.steps, proof.certificate.least_clearance)`,
  turn: ({ ratio, entry, exit }) => `from core import InvalidValue, Dance, Dragon, Turn

turn = Turn(1.7, 4.5, ${ratio}, entry_radius=${entry}, exit_radius=${exit})
print(turn.length, turn.angles, sum(turn.radii), turn.radii)
try:
    Dance(Dragon(), turn)
except InvalidValue as jam:
    print(jam)`,
  speed: ({ way, handle }) => `from core import Dance, Dragon, Turn, maximum_head_speed, trajectory

dance = Dance(Dragon(benches=40), Turn(1.7))
now = trajectory(dance, ${way})
print(now.speed[${handle}], now.speed[${handle - 1}])
fastest = maximum_head_speed(dance, 2.0)
print(fastest.speed_ratio, fastest.head_speed, fastest.handles)`,
};
