// The script of every page: report.html ends with `levade.report()`, certificate.html with `levade.certificate()`,
// library.html with `levade.library()`, a page that levade serves with `levade.live()`. The data are in the page (levade.report.page).

import { createCertificate } from "./certificate.js";
import { createLibrary } from "./library.js";
import { createLive } from "./live.js";
import { createReport } from "./report.js";

export const report = () => createReport(document.body, data());
export const certificate = () => createCertificate(document.body, data());
export const library = () => createLibrary(document.body, data());
export const live = () => createLive(document.body, data());

function data() {
  return JSON.parse(document.getElementById("levade-data").textContent);
}
