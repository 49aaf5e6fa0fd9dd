// How finely to draw: as the screen can show what stands still, coarser what moves where the graphics cannot keep up.

const SLOW = 0.045; // s a picture
const FAST = 0.02;
const FINEST = 2; // pixels of the canvas for one of the page

export class Pace {
  constructor() {
    this.share = 1;
    this.run = 0;
  }

  get ratio() {
    return Math.min(window.devicePixelRatio || 1, FINEST) * (this.moving ? this.share : 1);
  }

  // passed: seconds since the picture before, 0 if that is long ago. The ratio for the next one.
  next(passed, moving) {
    this.moving = moving;
    if (passed > SLOW) this.run = Math.max(this.run, 0) + (passed > 3 * SLOW ? 2 : 1);
    else if (passed > 0 && passed < FAST) this.run = Math.min(this.run, 0) - 1;
    if (this.run >= 4) this.change(0.75);
    else if (this.run <= -120) this.change(1 / 0.75);
    return this.ratio;
  }

  change(factor) {
    const least = 0.6 / Math.min(window.devicePixelRatio || 1, FINEST);
    this.share = Math.min(1, Math.max(this.share * factor, least));
    this.run = 0;
  }
}
