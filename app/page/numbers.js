/** Numbers as text. */

let exact = true;
/** Write numbers with all their digits from now on, or as people say them. */
export const setExact = (is) => (exact = is);
export const isExact = () => exact;
/** A number with some decimals; what rounds to zero has no sign. */
export const fixed = (value, decimals) => value.toFixed(decimals).replace(/^-(0(\.0+)?)$/, "$1");
/** A number with all of its decimals, or with the few that people say. */
export const formatNumber = (value, all, few) => fixed(value, exact ? all : few);

/** A bound with the given number of decimals, rounded to the side on which it still holds; way: 1 up, -1 down. */
export const bound = (value, decimals, way) => {
  const text = value.toFixed(decimals);
  return way * (Number(text) - value) < 0 ? (Number(text) + way * 10 ** -decimals).toFixed(decimals) : text;
};
