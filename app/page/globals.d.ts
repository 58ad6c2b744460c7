/** Names of types for the JSDoc of the scripts; `make lint` and editors read it, the page does not. */

type Editor = import("./edit.js").Editor;
type Jobs = import("./jobs.js").Jobs;
type Parts = import("./parts.js").Parts;
type Questions = import("./questions.js").Questions;
type Service = import("./api.js").Service;
type State = import("./state.js").State;
type Steps = import("./history.js").Steps;
/** English templates by their codes: so annotated they come into the catalogues. */
type Phrases = Record<string, string>;
/** x, y [m] */
type Point = [number, number];
/** A question to the service; what else it holds goes to fetch(). */
type Question = { query?: any; body?: object; file?: Blob; accept?: string; headers?: object; [option: string]: any };
/** The chart library, which is a script of its own. */
declare const uPlot: any;
