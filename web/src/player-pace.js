// How finely to draw: what stands still finer than the screen shows it, what moves coarser where the graphics cannot keep up.

const SLOW = 0.045; // s a picture
const FAST = 0.02;
const LEAST = 1.5; // pixels of the canvas for one of the page: more than one, for smooth edges
const MOST = 2;
const COARSE = 0.6;

export class Pace {
  // software: without graphics hardware, pictures take a hundred times as long
  constructor(software) {
    this.software = software;
    this.share = software ? COARSE : 1;
    this.start();
  }

  start() {
    this.mean = (SLOW + FAST) / 2;
    this.pictures = 0;
  }

  get ratio() {
    return this.moving ? Math.max(COARSE, this.finest * this.share) : this.finest;
  }

  get finest() {
    return this.software ? 1 : Math.min(Math.max(window.devicePixelRatio || 1, LEAST), MOST);
  }

  // passed: seconds since the picture before, 0 if that is long ago. The ratio for the next one.
  next(passed, moving) {
    this.moving = moving;
    if (passed > 0) {
      this.mean += 0.25 * (passed - this.mean);
      this.pictures += 1;
      if (this.pictures > 3 && this.mean > SLOW) this.change(0.75);
      else if (this.pictures > 120 && this.mean < FAST) this.change(1 / 0.75);
    }
    return this.ratio;
  }

  change(factor) {
    this.share = Math.min(1, Math.max(this.share * factor, COARSE / this.finest));
    this.start();
  }
}

export function isSoftware(gl) {
  const more = gl.getExtension("WEBGL_debug_renderer_info");
  const name = more ? gl.getParameter(more.UNMASKED_RENDERER_WEBGL) : "";
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}
