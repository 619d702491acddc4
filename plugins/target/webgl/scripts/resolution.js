const SLOW_DRAFT_MS = 50;
const FAST_DRAFT_MS = 24;
const TARGET_DRAFT_MS = 34;
const LOWEST_SCALE = 0.125;
const BAND_MS = 200;
const MOST_BANDS = 8;  // each of them has to go through all triangles

const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

/** How coarse drafts must be to follow the user's hand, given the time that the last one took. */
export class AdaptiveResolution {
    constructor() {
        this.scale = 1;  // of width and height
        this.bands = 1;  // in which a picture at full resolution is drawn, so that the user need not wait for all of it
    }

    /** `elapsed`: the milliseconds that the graphics took for a draft at this scale, most of them for its pixels. */
    adapt(elapsed) {
        this.bands = clamp(Math.ceil(elapsed / (this.scale * this.scale) / BAND_MS), 1, MOST_BANDS);
        if (elapsed >= FAST_DRAFT_MS && elapsed <= SLOW_DRAFT_MS) return;
        const factor = Math.sqrt(TARGET_DRAFT_MS / Math.max(elapsed, 1));
        this.scale = clamp(this.scale * clamp(factor, 0.25, 2), LOWEST_SCALE, 1);
    }
}
