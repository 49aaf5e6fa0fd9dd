// The script of every page: report.html ends with `levade.report()`, a page that levade serves with `levade.live()`. The data are in
// the page (levade.report.page).

import { createLive } from "./live.js";
import { createReport } from "./report.js";

export const report = () => createReport(document.body, data());
export const live = () => createLive(document.body, data());

function data() {
  return JSON.parse(document.getElementById("levade-data").textContent);
}
