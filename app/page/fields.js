/** The numbers that a person may set, and groups of them. */

/**
 * The numbers a person may set. `slider` is a useful range to
 * begin with: [from, to, step]; only: the path that has this number; centimetres: the unit here and on the slider;
 * doors: behind which it is one of the few numbers. An
 * empty text leaves the number to the service.
 * @type {{name: string, value: string, group: string, slider: [number, number, number], only?: string, centimetres?: boolean, doors?: string[]}[]}
 */
export const FIELDS = [
  { name: "pitch", value: "0.55", group: "path", slider: [0.3, 2, 0.001], doors: ["contest", "look"] },
  { name: "start_turns", value: "16", group: "path", slider: [4, 40, 0.5] },
  { name: "turning_diameter", value: "9", group: "path", slider: [2, 16, 0.1], doors: ["contest"] },
  { name: "ratio", value: "2", group: "path", slider: [0.5, 4, 0.05], only: "turn" },
  { name: "entry_radius", value: "", group: "path", slider: [4, 5, 0.001], only: "turn" },
  { name: "exit_radius", value: "", group: "path", slider: [3.5, 5, 0.001], only: "turn" },
  { name: "benches", value: "223", group: "dragon", slider: [1, 400, 1], doors: ["contest", "village", "look"] },
  { name: "head_length", value: "3.41", group: "dragon", slider: [1, 6, 0.01] },
  { name: "body_length", value: "2.2", group: "dragon", slider: [1, 4, 0.01], doors: ["village"] },
  { name: "width", value: "0.3", group: "dragon", slider: [0.05, 0.6, 0.005] },
  { name: "overhang", value: "0.275", group: "dragon", slider: [0, 0.45, 0.005] },
  { name: "head_speed", value: "1", group: "motion", slider: [0.1, 3, 0.05], doors: ["village"] },
  { name: "margin", value: "0", group: "motion", slider: [0, 0.2, 0.005] },
  { name: "speed_limit", value: "2", group: "motion", slider: [1, 4, 0.05], only: "turn" },
  { name: "stray", value: "0", group: "people", slider: [0, 20, 0.1], centimetres: true, doors: ["contest", "village"] },
  { name: "hole", value: "0", group: "people", slider: [0, 10, 0.1], centimetres: true },
  { name: "pin", value: "0", group: "people", slider: [0, 10, 0.1], centimetres: true },
];

/** What the service says of the fields of its questions: their labels and hints in English, and [least, most, unit]. */
export const { labels: LABELS = {}, hints: HINTS = {}, limits: LIMITS = {} } = JSON.parse(/** @type {any} */ (globalThis.document?.querySelector("meta[name=fields]"))?.content ?? "{}");
/** What a number without a text is. @type {Phrases} */
export const EMPTY_NAMES = {
  entry_radius: "circle",
  exit_radius: "as the entry",
};

const namesOf = (wanted) => FIELDS.filter(({ group }) => group === wanted).map(({ name }) => name);
export const DRAGON = namesOf("dragon");
/** Numbers that define a contact. */
export const CONTACT = ["margin", ...namesOf("people")];
/** Largest distance of every hole from its place [m]: the stray of people, and half the difference of hole and pin. */
export const strayOf = (/** @type {any} */ { stray, hole, pin }) => Number(stray) + (hole - pin) / 2;
/** The numbers of a turn in addition to those of its coils. */
export const TURN = ["turning_diameter", "ratio", "entry_radius", "exit_radius"];
/** Texts as numbers; other texts stay unchanged, so that the service refuses them. */
export const numbersOf = (texts) =>
  Object.fromEntries(Object.entries(texts).map(([name, text]) => [name, text.trim() && Number.isFinite(Number(text)) ? Number(text) : text]));
