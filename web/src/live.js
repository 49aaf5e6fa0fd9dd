// The pages that levade serves: createLive(element, data) shows a solve as it goes on, or a robot or a task to look at; `data.kind`
// says which.

import { createView } from "./view.js";
import { createWatch } from "./watch.js";

export function createLive(element, data) {
  const create = { watch: createWatch, view: createView }[data.kind];
  create(element, data);
  document.documentElement.dataset.ready = "";
}
