/** Numbers as text. */

/** A bound with the given number of decimals, rounded to the side on which it still holds; way: 1 up, -1 down. */
export const bound = (value, decimals, way) => {
  const text = value.toFixed(decimals);
  return way * (Number(text) - value) < 0 ? (Number(text) + way * 10 ** -decimals).toFixed(decimals) : text;
};
