// The pages that levade serves: a solve as it goes on, or a robot or a task to look at. Which one, its data say.

import "./style.css";
import "./live.css";
import { createView } from "./view.js";
import { createWatch } from "./watch.js";

const data = JSON.parse(document.getElementById("levade-data").textContent);
const create = { watch: createWatch, view: createView }[data.kind];
create(document.body, data);
document.documentElement.dataset.ready = "";
