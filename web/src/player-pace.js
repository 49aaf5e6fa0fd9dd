// How finely to draw: as the screen can show what stands still, coarser what moves where the graphics cannot keep up.

const SLOW = 0.045; // s a picture
const FAST = 0.02;
const FINEST = 2; // pixels of the canvas for one of the page
const COARSEST = 0.6;

export class Pace {
  constructor() {
    this.share = 1;
    this.start();
  }

  start() {
    this.mean = (SLOW + FAST) / 2;
    this.pictures = 0;
  }

  get ratio() {
    return this.finest * (this.moving ? this.share : 1);
  }

  get finest() {
    return Math.min(window.devicePixelRatio || 1, FINEST);
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
    this.share = Math.min(1, Math.max(this.share * factor, COARSEST / this.finest));
    this.start();
  }
}
