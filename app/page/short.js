/** The short form of an address, as it stands in codes on paper: app/files/addresses.py writes it, and says how. */

const [CHARACTERS, ESCAPE, FIRST_WORD] = ["0123456789,._-!", 15, 128];
const WORDS = "&path=route &path=turn &door=village &door=contest &route= &things= &yard= &walk= &raw= &start= &origin= &grid= &corner= &begin= &limit= &benches= &bench= &dragon= &dances= &pitch= &start_turns= &turning_diameter= &ratio= &entry_radius= &exit_radius= &head_length= &body_length= &width= &overhang= &head_speed= &margin= &speed_limit= &stray= &hole= &pin= &csv= &passages= &beats= &start_clock= &begin_clock= &door= &path= _* ~o. ~g. ~s. .. .! 0! !benches: !pitch: !start_turns: !rotation: !delay: !path: name: 00 50 %20 %E3%8 %E4%B %E5% %E6% %E7% %E8% %E9% %8 %9 %A %B %".split(" ");
const [HEX, SHORT] = [16, "z="];

/** What a number stands for: parts of a query, each after an ampersand; nothing for any other text. */
function longForm(digits) {
  const [mark, ...halves] = /^\d+$/.test(digits) ? [...BigInt(digits).toString(HEX)].map((one) => Number.parseInt(one, HEX)) : [];
  let text = "";
  for (let k = 0; mark === 1 && k < halves.length; k++) {
    const code = halves[k] === ESCAPE ? HEX * halves[++k] + halves[++k] : null;
    text += code === null ? CHARACTERS[halves[k]] : code < FIRST_WORD ? String.fromCharCode(code) : (WORDS[code - FIRST_WORD] ?? "");
  }
  return text.slice(1);
}

/** The query of an address with its short form written out. query: with its question mark, or empty */
export const writtenOut = (query) =>
  query.includes(SHORT) ? query.replace(/([?&])z=([^&]*)/, (_, before, digits) => before + longForm(digits)) : query;
