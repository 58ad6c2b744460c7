/** The jobs that this browser has started, or with a token all jobs of the service: progress, result and removal. */

import { Problem, Superseded } from "./api.js";
import { $, bearer, button, download, make } from "./elements.js";
import { LABELS } from "./fields.js";
import { announce, announceRefusal } from "./overlays.js";
import { QUESTIONS, TABLE } from "./sweeps.js";
import { language, say } from "./text.js";

const STORED = "bench-dragon-jobs";
/** Most jobs that the browser remembers. */
const REMEMBERED = 50;
/** Time between two checks of an unfinished job [ms]. */
const LOOK = 1_000;
/** The forms in which tables of sweeps can be saved. */
const TABLES = { CSV: "text/csv", Parquet: TABLE, Arrow: "application/vnd.apache.arrow.file" };
/** Endings of file names, by media type. */
const ENDINGS = { "video/mp4": ".mp4", "image/gif": ".gif", "application/json": ".json", "text/csv": ".csv", "application/geo+json": ".geojson", "image/vnd.dxf": ".dxf", "application/pdf": ".pdf", "application/zip": ".zip", [TABLE]: ".parquet" };
/** Names of the jobs that Keep starts. @type {Phrases} */
const NAMES = { films: "Film of the dance", "contest-kit": "The whole contest kit", "collision-time": "First contact with its certificate", "minimum-pitch": "Minimum pitch with its proof", envelope: "Ground that benches sweep", plan: "Plan on paper, true to scale", cues: "A cue card for each bench", check: "The verdict on the whole dance", tolerance: "How far people may stray, with its proof", clearance: "Clearance, every second", trajectory: "Every handle, every second" };
const UNFINISHED = ["accepted", "running"];

/** The remembered jobs; empty if the browser allows no storage. */
function remembered() {
  try {
    const stored = JSON.parse(localStorage.getItem(STORED));
    return Array.isArray(stored) ? stored.filter(({ id }) => /^[0-9a-f]{48}$/.test(id)) : [];
  } catch {
    return [];
  }
}

export class Jobs {
  /** id -> {spec if this browser asked, status, follow} */
  #jobs = new Map();
  #timer = 0;

  /**
   * show(columns, spec): draw the table of a sweep
   * @param {Service} service
   */
  constructor(list, service, show) {
    this.list = list;
    this.service = service;
    this.show = show;
    for (const { id, spec } of remembered()) this.#jobs.set(id, { spec });
    $("#token").addEventListener("change", () => this.#listAll());
    this.#look();
  }

  /** Start a sweep. throws: Problem */
  async start(spec) {
    this.#add(await this.service.ask("sweep", "sweeps", { body: spec, headers: bearer() }), spec);
  }

  /** Ask a question as a job, and follow it. accept: type of its result; number: of a contest's question; follow(status): called with each status; throws: Problem */
  async begin(path, /** @type {any} */ { query, body, accept, number }, follow) {
    const headers = { Prefer: "respond-async", ...bearer() };
    const status = await this.service.ask(`job ${path} ${accept} ${number}`, path, { query, body, headers, accept: `${accept}, application/json;q=0.1` });
    this.#add(status, { question: path, over: {}, number }, follow);
  }

  #add(status, spec, follow = null) {
    follow?.(status);
    this.#jobs = new Map([[status.jobID, { spec, status, follow, opened: false }], ...this.#jobs]);
    this.#remember();
    announce(() => say("The job has started."));
    this.#look();
  }

  #remember() {
    const own = [...this.#jobs].filter(([, { spec }]) => spec).slice(0, REMEMBERED);
    try {
      localStorage.setItem(STORED, JSON.stringify(own.map(([id, { spec }]) => ({ id, spec }))));
    } catch {
      // Without storage in the browser the list ends with the page.
    }
  }

  async #listAll() {
    if (!$("#token").value.trim()) return;
    try {
      const { jobs } = await this.service.ask("jobs", "jobs", { headers: bearer() });
      for (const status of jobs) this.#jobs.set(status.jobID, { ...this.#jobs.get(status.jobID), status });
      this.render();
      this.#look();
    } catch (error) {
      announceRefusal(error);
    }
  }

  /** Ask for the progress of every unfinished job, and of those told in another language, and again after a while. */
  async #look() {
    clearTimeout(this.#timer);
    this.render();
    for (const [id, job] of this.#jobs) {
      if (job.language === language() && !UNFINISHED.includes(job.status?.status)) continue;
      try {
        Object.assign(job, { language: language(), status: await this.service.ask(`job ${id}`, `jobs/${id}`, { cache: "no-store" }) });
        job.follow?.(job.status);
      } catch (error) {
        if (error instanceof Superseded) return;
        if (!(error instanceof Problem)) throw error;
        this.#forget(id);
      }
      if (job.opened === false && job.status?.status === "successful" && isTable(job.status)) this.#open(id, job);
    }
    this.render();
    if ([...this.#jobs.values()].some(({ status }) => UNFINISHED.includes(status?.status))) {
      this.#timer = setTimeout(() => this.#look(), LOOK);
    }
  }

  /** After a change of language, in which the service says how far each job is. */
  translate() {
    this.#look();
  }

  #forget(id) {
    this.#jobs.delete(id);
    this.#remember();
    this.render();
  }

  async #open(id, job) {
    job.opened = true;
    try {
      await this.show(await this.service.ask("map", `jobs/${id}/result`), job.spec);
      const forms = resultOf(job.status).type === TABLE ? Object.keys(TABLES) : [];
      $("#map-save").parentElement.hidden = !forms.length;
      $("#map-save").replaceChildren(...forms.map((form) => button({ textContent: form, "data-save": form }, () => this.#save(id, form))));
      announce(() => say("The map is drawn."));
    } catch (error) {
      announceRefusal(error);
    }
  }

  async #save(id, form) {
    try {
      const name = `sweep-${id.slice(0, 8)}.${form.toLowerCase()}`;
      download(await this.service.ask(`save ${id} ${form}`, `jobs/${id}/result`, { accept: TABLES[form] }), name);
      announce(() => say("Saved {name}.", { name }));
    } catch (error) {
      announceRefusal(error);
    }
  }

  /** Cancel a job that still goes on; one that has ended meanwhile keeps its result. */
  async #cancel(id) {
    try {
      const status = await this.service.ask(`cancel ${id}`, `jobs/${id}`, { cache: "no-store" });
      if (UNFINISHED.includes(status.status)) await this.#end(id);
      else this.#look();
    } catch (error) {
      announceRefusal(error);
    }
  }

  async #end(id) {
    try {
      const status = await this.service.ask(`end ${id}`, `jobs/${id}`, { method: "DELETE" });
      const job = this.#jobs.get(id);
      if (status) job.follow?.((job.status = status));
      else this.#forget(id);
      this.render();
    } catch (error) {
      announceRefusal(error);
    }
  }

  /** Show the list. A row stays while its buttons do, so that a press on one counts. */
  render() {
    const focus = document.activeElement?.id;
    const rows = [...this.#jobs].filter(([, { status }]) => status).map(([id, job]) => this.#row(id, job));
    if (rows.some((row, k) => row !== this.list.children[k]) || rows.length !== this.list.children.length) this.list.replaceChildren(...rows);
    $("#no-jobs").hidden = rows.length > 0;
    if (focus && this.list.querySelector(`#${CSS.escape(focus)}`)) $(`#${CSS.escape(focus)}`).focus();
  }

  /** The row of a job: a new one in another state or language, else the one before with its progress. */
  #row(id, job) {
    const { status } = job;
    const drawn = `${document.documentElement.lang} ${status.status}`;
    if (job.drawn !== drawn) Object.assign(job, { drawn, row: this.#newRow(id, job) });
    job.row.querySelector(".state").textContent = status.sentence;
    const bar = job.row.querySelector("progress");
    if (bar) {
      bar.value = status.progress;
      bar.setAttribute("aria-label", `${what(status.processID, job.spec)}: ${status.progress} %`);
    }
    return job.row;
  }

  #newRow(id, job) {
    const { status } = job;
    const going = UNFINISHED.includes(status.status);
    const name = what(status.processID, job.spec);
    const labelled = (key, words, act) => button({ id: `${key}-${id}`, textContent: words, "aria-label": `${words}: ${name}` }, act);
    const words = Object.entries({ title: name, state: "" }).map(([className, textContent]) => make("span", { className, textContent }));
    const row = make("li", { "data-state": status.status }, ...words);
    if (going) row.append(make("progress", { max: 100 }));
    const { href, type } = resultOf(status);
    const buttons = make("span", { className: "buttons" });
    if (href && isTable(status)) buttons.append(labelled("jobMap", say("Map"), () => this.#open(id, job)));
    if (href) buttons.append(make("a", { href: `jobs/${id}/result`, download: `${status.processID}-${id.slice(0, 8)}${ENDINGS[type] ?? ""}`, textContent: say("Result") }));
    buttons.append(going ? labelled("jobCancel", say("Cancel"), () => this.#cancel(id)) : labelled("jobRemove", say("Remove"), () => this.#end(id)));
    row.append(buttons);
    if (status.problem) row.append(make("p", { className: "error", textContent: status.problem.sentence ?? status.problem.detail }));
    return row;
  }
}

/** Show on the button that has begun a job how far it is. */
export function showShare(button, { status, progress }) {
  const going = UNFINISHED.includes(status);
  button.classList.toggle("going", going);
  button.style.setProperty("--share", `${progress}%`);
  button.querySelector(".share").textContent = going ? ` ${progress} %` : "";
}

const resultOf = ({ links }) => links.find(({ rel }) => rel === "results") ?? {};
/** True if the result is the table of a sweep, which the page can draw. */
const isTable = (status) => status.processID === "sweep" && ["application/json", TABLE].includes(resultOf(status).type);

function what(process, spec) {
  if (spec?.number) return say("Question {number}", spec);
  const name = process.replace(/_of$/, "").replaceAll("_", "-");
  if (process !== "sweep") return name in NAMES ? say(NAMES[name]) : process;
  if (!spec) return say("Sweep");
  const names = Object.keys(spec.over).map((name) => say(LABELS[name]));
  return say("{question} over {names}", { question: say(QUESTIONS[spec.question].title), names: names.join(say(" and ")) });
}
