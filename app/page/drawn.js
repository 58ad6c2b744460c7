/** A drawn dance on the page: joins the picture, the form, the files and the verdict. */

import { Beside } from "./beside.js";
import { Change } from "./change.js";
import { placesOf } from "./changes.js";
import { EMPTY, walkOf, yardOf } from "./drawing.js";
import { Editor } from "./edit.js";
import { $, $$, hide, make, textButton } from "./elements.js";
import { strayOf } from "./fields.js";
import { Figure } from "./figure.js";
import { Files } from "./files.js";
import { stepsOf } from "./history.js";
import { Judgement } from "./judgement.js";
import { addKits } from "./kits.js";
import { cornersOf, knotsOf } from "./knots.js";
import { Menu } from "./menu.js";
import { Photo } from "./photo.js";
import { announceStep } from "./overlays.js";
import { PRESETS, PRESET_NAMES, shownAt } from "./presets.js";
import { Propose } from "./propose.js";
import { RouteForm } from "./route.js";
import { addLayers } from "./shown.js";
import { phrase, say } from "./text.js";
import { layers } from "./venue.js";

/** A first dance for a village: {drawing, with its things named in the language of the page, time at which it is shown}. */
export function village() {
  const things = PRESETS.village.things.map((thing) => ({ ...thing, name: say(thing.name) }));
  return { drawing: { ...PRESETS.village, things }, time: shownAt(PRESETS.village) };
}

/** Turns between the points of a freed figure that are tried, the largest first [rad], each with a largest distance [m]; the last is that of other paths. */
const TURNS = [[Math.PI / 2, Infinity], [Math.PI / 3, Infinity], [Math.PI / 4, 40], []];
/** Part of the ground across a picture that shows a bend [m]. */
const ACROSS = 12;
/** Boxes about spirals, which are empty here. */
const SPIRAL_ALONE = ["#minimum-pitch", "#curve", "#scan"];

export class Drawn {
  /** The failure shown on the picture. */
  #failure = null;
  /** A failure whose benches must still be moved into view. */
  #wanted = null;
  /** What the verdict says of the proposals. */
  #remark = "";

  /**
   * several(content, name): opens a dance of several dragons; placed(): called when one of them has a proposed dance
   * @param {{ state: State, service: Service, questions: Questions, dance: any, draw: any, several: any, placed: any }} parts
   */
  constructor({ state, service, questions, dance, draw, several, placed }) {
    this.state = state;
    this.service = service;
    this.questions = questions;
    this.picture = dance;
    this.draw = draw;
    this.steps = stepsOf(state);
    const course = () => (questions.course?.drawing === state.get("drawing") ? questions.course : null);
    this.editor = new Editor(dance, state, this.steps, course, () => (this.#isEmpty ? null : questions.course), () => this.show());
    questions.isHeld = () => this.editor.isDragging;
    const files = new Files(state, this.steps, service, questions, several);
    this.photo = new Photo(state, this.editor, () => this.#photographed());
    this.form = new RouteForm($("#route"), state, this.steps, this.editor, files, this.photo);
    this.beside = new Beside($("#beside"), dance, this.editor, this.form, () => (this.#isEmpty ? null : questions.course?.gaps));
    addKits(this.editor);
    this.change = new Change($("#stage"));
    this.figure = new Figure($("#stage"), this.editor, () => this.#free());
    new Menu($("#stage"), this.editor);
    this.propose = new Propose($("#place"), { state, service, questions, steps: this.steps, editor: this.editor, changed: () => this.show(), placed });
    this.judgement = new Judgement($("#judgement"), (failure) => this.#seek(failure), (point) => this.#look(point, ACROSS));
    this.#invite();
    const { below, names, above } = layers(dance, () => this.#visible());
    this.layers = addLayers(dance, draw);
    dance.below.push((pen) => this.#isRoute && !dance.hidden.has("photo") && this.photo.draw(pen), below);
    dance.names.push(names);
    dance.above.push(above, () => this.editor.place(), () => this.beside.place());
  }

  get #isRoute() {
    return this.state.get("path") === "route";
  }

  /** True without a drawing that can be danced. */
  get #isEmpty() {
    const { points, path } = this.state.get("drawing");
    return points.length < 2 && !path;
  }

  /** What comes next, by its name in keys.js; null while it is waited for. */
  get next() {
    return this.#isEmpty ? this.propose.next : "answers";
  }

  #visible() {
    if (!this.#isRoute) return null;
    const { course } = this.questions;
    const editing = this.editor.active;
    const selected = editing ? this.editor.item : null;
    return { drawing: this.state.get("drawing"), editing, selected, chosen: this.editor.items, measured: editing ? this.editor.measured : [], held: this.editor.held, failure: this.#failure, course, benches: Number(this.state.get("benches")) };
  }

  /** Make points of a figure: as few as can be danced, by the service's verdict. */
  async #free() {
    const drawing = this.state.get("drawing");
    const { questions } = this;
    const ask = (path, shown, more) => this.service.ask("free", path, { body: { ...questions.checkBody({ ...questions.drawn(), drawing: shown }), ...more } }).catch(() => null);
    const corners = cornersOf(drawing.path);
    const course = corners || questions.course?.drawing === drawing ? questions.course : await ask("course", drawing, {});
    let freed = drawing;
    for (const knots of [corners, ...TURNS.map((turn) => course && knotsOf(course, ...turn))].filter(Boolean)) {
      freed = { ...drawing, ...knots, path: null, start: null };
      const report = await ask("check", freed, { cross_check: "none", details: false });
      if (this.state.get("drawing") !== drawing) return;
      if (report?.verdict === "passes") break;
    }
    this.steps.take(freed);
    $("#canvas").focus({ preventScroll: true });
    announceStep(() => say("The figure is now a path of {count} points.", { count: placesOf(freed, null).size }));
  }

  /** After a change of the photo: all of it is in view, unless a person has moved the picture. */
  #photographed() {
    if (this.#isRoute) this.picture.setPath(this.#isEmpty ? null : this.questions.course, this.around(), this.yard());
    this.show();
  }

  /** The offers without a drawing: draw a path, or begin with a preset. */
  #invite() {
    const presets = Object.keys(PRESETS).map((name) => textButton(PRESET_NAMES[name], () => this.form.beginWith(name), { "data-preset": name }));
    const words = (tag, text) => make(tag, { "data-text": text });
    $("#invite").append(words("h3", phrase("Where should the dragon go?")), textButton("✎ Draw a path", () => this.#draw(), { className: "main" }), words("p", phrase("or begin with")), make("div", {}, ...presets));
  }

  /** Draw from nothing; by keyboard too, so the picture gets the focus. */
  #draw() {
    this.editor.turn(true);
    $("#canvas").focus();
  }

  /** Begin to draw; an empty drawing starts with an S-shaped path. */
  choose() {
    if (this.state.get("drawing") === EMPTY) this.state.set({ drawing: PRESETS.s }, false);
    this.state.choosePath("route");
    this.editor.turn(true);
  }

  /** Points of the venue, which must be visible together with the path. */
  around() {
    return this.#isRoute ? [...this.state.get("drawing").things.flatMap(({ points }) => points), ...this.photo.corners] : [];
  }

  /** Corners of a square with streets without them, or null. */
  yard() {
    return this.#isRoute ? this.state.get("drawing").yard : null;
  }

  /** After a change of the drawing or of the kind of dance. */
  show() {
    const drawn = this.#isRoute;
    const drawing = this.state.get("drawing");
    const { points } = drawing;
    $("main").classList.toggle("drawn", drawn);
    this.picture.drawn = drawn;
    $("#route").hidden = !drawn;
    $("#judgement").hidden = !drawn && !this.state.get("dances");
    $("#save").disabled = this.#isEmpty && !points.length && !drawing.things.length;
    this.layers.show(drawn);
    this.editor.show();
    this.beside.show();
    this.photo.show();
    this.figure.show();
    if (!drawn || this.#isEmpty) this.change.forget();
    else if (!this.editor.active) this.change.clear();
    const empty = drawn && this.#isEmpty;
    $("main").classList.toggle("empty", empty);
    hide($("#invite"), !empty || points.length > 0 || this.editor.active || yardOf(drawing).length > 0 || this.photo.corners.length > 0);
    this.propose.show();
    if (!drawn) return;
    this.form.show();
    for (const box of SPIRAL_ALONE) $(box).setAttribute("aria-busy", false);
    if (empty) {
      // Without a question there is no answer to wait for.
      for (const box of $$("main [aria-busy=true]")) box.setAttribute("aria-busy", false);
      this.picture.setPath(null, this.around());
      this.picture.scene.pose = null;
      for (const id of ["#inset", "#clock-help"]) $(id).hidden = true;
      this.judgement.begin(this.propose.next);
      this.form.offer(null);
    } else if (this.#remark !== this.propose.remark) this.judged();
    this.draw();
  }

  /** After an answer about the path: how near benches come; the path of an address gets the points through which it can be edited. */
  knotted() {
    this.beside.show();
    const drawing = this.state.get("drawing");
    const { course } = this.questions;
    if (course && !drawing.points.length && walkOf(drawing.path)) this.state.set({ drawing: { ...drawing, ...knotsOf(course) } }, false);
  }

  /** Show the service's verdict on the dance. */
  judged() {
    const { dance, refusals } = this.questions;
    if (dance?.kind !== "route" || !this.#isRoute || refusals.has("contact")) return;
    if (this.editor.base) this.change.quick(dance, this.editor.base);
    if (!dance.failures.includes(this.#failure)) this.#failure = null;
    this.#remark = this.propose.remark;
    this.judgement.show({ ...dance, lines: [this.#remark] });
    this.form.offer(dance);
  }

  /** Say what the last change has done. answer: certified; of: the dance */
  certified(answer, of) {
    if (of?.kind === "route" && of === this.questions.dance) this.change.certified(answer, this.editor.base, of.drawing, strayOf(of.numbers) > 0);
  }

  /** Show that the service refused the dance, with a better reason if one is known. */
  refused() {
    const refusal = this.questions.refusals.get("contact") ?? this.questions.refusals.get("course");
    if (!this.#isRoute || this.#isEmpty || !refusal) return;
    this.form.offer(null);
    $("#clock-help").hidden = true;
    const fields = this.questions.refusals.has("contact") ? this.questions.fieldsOf("contact") : [];
    if (fields.length) this.judgement.wait(fields);
    else this.judgement.refuse(refusal.problem, this.questions.course);
  }

  /** Move the benches at fault into view once, after a pose is shown. */
  posed(pose) {
    const failure = this.#wanted;
    if (!failure || !pose.dance || pose.time !== failure.time) return;
    this.#wanted = null;
    const k = failure.benches[0] ?? 0;
    this.#look([pose.x[k], pose.y[k]]);
  }

  translate() {
    this.change.clear();
    this.show();
    this.judged();
    this.refused();
  }

  #seek(failure) {
    this.#failure = this.#wanted = failure;
    const { end } = this.questions.dance;
    this.state.set({ time: failure.time >= end ? null : failure.time });
    const { pose } = this.picture.scene;
    if (pose) this.posed(pose);
    this.draw();
  }

  /** Move the picture to a point [m] outside the view. across: part of the ground to enlarge there [m]; none: as large as before */
  #look(point, across = 0) {
    const { view } = this.picture;
    if (across) {
      view.set(...point, Math.max(view.scale, Math.min(view.width, view.height) / across));
      view.moved(true);
    } else view.reveal(...point);
    this.draw();
  }
}
