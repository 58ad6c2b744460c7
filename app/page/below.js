/** What stands below the dance: the people, what can be saved, many designs with their jobs, and grading. It loads when a person is near. */

import { Crew } from "./crew.js";
import { Designs } from "./designs.js";
import { Grader } from "./grade.js";
import { Keep } from "./keep.js";

export class Below {
  /**
   * names: of the state's numbers; player: knows the time shown
   * @param {{ state: State, service: Service, questions: Questions, names: string[], canvas: any, player: any }} parts
   */
  constructor({ state, service, questions, names, canvas, player }) {
    const { jobs, map } = new Designs(state, service, names);
    this.jobs = jobs;
    this.map = map;
    this.keep = new Keep({ service, questions, jobs, canvas });
    this.crew = new Crew(service, questions, player);
    this.grader = new Grader(service);
  }

  /** Show what belongs to the dance. */
  show() {
    this.keep.show();
    this.crew.show();
  }

  translate(language) {
    this.grader.translate(language);
    this.keep.translate();
    this.crew.show();
    this.jobs.translate();
    this.map.draw();
  }

  restyle() {
    this.map.draw();
    this.grader.show();
  }
}
