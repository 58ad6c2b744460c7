/** Reads tables of benches measured one by one, from text or a file, in the service's format. */

/** First letters of the column names: the name, and the sizes in the order of a table. */
const COLUMNS = { names: /^(name|名称|姓名)/i, lengths: /^(length|长)/i, widths: /^(width|宽)/i, overhangs: /^(overhang|孔距|端距)/i };
const QUOTED = /^"(.*)"$/s;

/** Entries of a line; a quoted one may hold the separator. */
function cellsOf(line, separator) {
  const cells = line.match(new RegExp(`(?:^|${separator})\\s*("(?:[^"]|"")*"|[^${separator}]*)`, "g")) ?? [];
  return cells.map((cell, k) => cell.slice(k && 1).trim().replace(QUOTED, (_, inner) => inner.replaceAll('""', '"')).trim());
}

/** First bytes of text in UTF-16, and of workbooks: .xlsx and .ods, which are archives, and .xls. */
const WIDE = { "255,254": "utf-16le", "254,255": "utf-16be" };
const WORKBOOKS = ["80,75", "208,207"];

/** The text of a table in a file: UTF-8 or UTF-16, otherwise GB 18030, as Chinese versions of Excel write it; null for a workbook. */
export async function tableText(file) {
  const bytes = new Uint8Array(await file.arrayBuffer());
  const mark = bytes.slice(0, 2).join();
  if (WORKBOOKS.includes(mark)) return null;
  try {
    return new TextDecoder(WIDE[mark] ?? "utf-8", { fatal: true }).decode(bytes);
  } catch {
    return new TextDecoder("gb18030").decode(bytes);
  }
}

/** True for the cells of a bench in a table without names of columns: three numbers, alone or after a name. */
const holdsSizes = (cells) => [3, 4].includes(cells.length) && cells.slice(-3).every((cell) => cell && Number.isFinite(Number(cell.replace(",", "."))));

/** The benches of a table that the service accepts: {names, lengths, widths, overhangs}, head first [m]. */
export function benchesOf(text) {
  let lines = text.split(/\r?\n|\r/).filter((line) => line.trim());
  const stated = /^ *sep=([\t;,]) *$/.exec(lines[0] ?? "")?.[1];
  if (stated) lines = lines.slice(1);
  const first = lines[0] ?? "";
  const separator = stated ?? ["\t", ";"].find((mark) => first.includes(mark)) ?? ",";
  const own = cellsOf(first, separator);
  const isBench = holdsSizes(own);
  const heads = isBench ? ["name", "length", "width", "overhang"].slice(-own.length) : own;
  const rows = lines.slice(isBench ? 0 : 1).map((line) => cellsOf(line, separator)).filter((row) => row.some(Boolean));
  const column = (pattern) => {
    const at = heads.findIndex((head) => pattern.test(head));
    return rows.map((row) => row[at] ?? "");
  };
  const numbers = (pattern) => column(pattern).map((cell) => Number(cell.replace(",", ".")));
  const { names, lengths, widths, overhangs } = COLUMNS;
  return { names: column(names), lengths: numbers(lengths), widths: numbers(widths), overhangs: numbers(overhangs) };
}

/** The numbers of a dragon whose benches are listed one by one: of its head, and the largest of all. */
export function numbersOfListed(listed) {
  const { lengths, widths, overhangs: [overhang] } = listed;
  return { listed, benches: lengths.length, head_length: lengths[0], body_length: Math.max(...lengths), width: Math.max(...widths), overhang };
}

const quoted = (name) => (/[",]/.test(name) ? `"${name.replaceAll('"', '""')}"` : name);

/** The table of a dragon in a request; an empty text for equal benches without names. */
export function tableOf({ csv, lengths, widths, overhangs, names, ...equal }) {
  if (csv !== undefined) return csv;
  if (!lengths && !names?.some(Boolean)) return "";
  const { benches = 223, head_length: head = 3.41, body_length: body = 2.2, width = 0.3, overhang = 0.275 } = equal;
  const own = lengths ?? Array.from({ length: benches }, (_, k) => (k ? body : head));
  const rows = own.map((length, k) => [quoted(names?.[k] ?? ""), length, widths?.[k] ?? width, overhangs?.[k] ?? overhang].join());
  return ["name,length,width,overhang", ...rows].join("\n");
}
