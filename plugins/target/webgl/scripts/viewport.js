import { appearanceOf } from "./appearance.js";

const REFINEMENT_DELAY_MS = 140;
const SLOW_FRAME_MS = 50;
const FAST_FRAME_MS = 24;
const MAX_PIXELS = 2560 * 1600;
const PIXEL_CENTER = [0.5, 0.5];

/**
 * Keeps the canvas up to date: one sample per pixel, at a lower resolution where frames are slow, while something changes;
 * all samples once it rests.
 */
export class Viewport {
    /** `container`: the element that the canvas is fitted into. `onError` gets an error, or null after a successful frame. */
    constructor({ canvas, container, renderer, settings, onError }) {
        Object.assign(this, { canvas, container, renderer, settings, onError });
        this.resolutionScale = 1;
        this.film = null;
        this.frameRequest = 0;
        this.refinementTimer = 0;
        this.lastDraftTime = 0;
        this.consecutiveDrafts = 0;
        this.nextSample = -1;  // of the refinement; -1: a draft comes first
        this.resizeObserver = new ResizeObserver(() => this.invalidate());
        this.resizeObserver.observe(container);
        settings.listeners.push(() => this.invalidate());
        this.invalidate();
    }

    stop() {
        this.resizeObserver.disconnect();
        cancelAnimationFrame(this.frameRequest);
        clearTimeout(this.refinementTimer);
        this.isStopped = true;
    }

    /** Starts anew with a draft, at the next frame. */
    invalidate() {
        if (this.isStopped) return;
        this.appearance = null;
        this.nextSample = -1;
        clearTimeout(this.refinementTimer);
        this.requestFrame();
    }

    requestFrame() {
        if (this.frameRequest === 0) this.frameRequest = requestAnimationFrame((time) => this.drawFrame(time));
    }

    /** The largest size in CSS pixels that fits into the container with the scene's aspect ratio. */
    displaySize() {
        const { width, height } = this.settings.scene.image;
        const box = this.container.getBoundingClientRect();
        const ratio = Math.min(box.width / width, box.height / height);
        return [Math.max(1, Math.floor(width * ratio)), Math.max(1, Math.floor(height * ratio))];
    }

    /** Makes the film match the picture's size on the screen, times `resolutionScale`. */
    prepareFilm(resolutionScale) {
        const [width, height] = this.displaySize();
        this.canvas.style.width = `${width}px`;
        this.canvas.style.height = `${height}px`;
        const ratio = Math.min(devicePixelRatio || 1, Math.sqrt(MAX_PIXELS / (width * height))) * resolutionScale;
        const pixels = [width, height].map((size) => Math.max(1, Math.round(size * ratio)));
        if (this.film && this.film.width === pixels[0] && this.film.height === pixels[1]) return;
        this.film?.release();
        this.film = null;
        this.film = this.renderer.createFilm(...pixels);
    }

    show(target) {
        // Resizing clears the canvas, so that it is drawn to in the same frame.
        if (this.canvas.width !== this.film.width) this.canvas.width = this.film.width;
        if (this.canvas.height !== this.film.height) this.canvas.height = this.film.height;
        this.renderer.encode(target, null);
    }

    drawFrame(time) {
        this.frameRequest = 0;
        try {
            this.nextSample < 0 ? this.drawDraft(time) : this.refine();
        } catch (error) {
            this.onError(error);
        }
    }

    drawDraft(time) {
        this.adaptResolution(time);
        this.appearance = appearanceOf(this.settings);
        this.renderer.prepare(this.appearance);
        this.prepareFilm(this.resolutionScale);
        this.renderer.drawSample(this.film, this.appearance, PIXEL_CENTER);
        this.show(this.film.picture);
        this.onError(null);
        this.nextSample = 0;
        this.refinementTimer = setTimeout(() => this.requestFrame(), REFINEMENT_DELAY_MS);
    }

    refine() {
        const { renderer } = this, positions = this.settings.scene.image.sample_positions;
        this.prepareFilm(1);
        if (this.nextSample === 0) renderer.clearSum(this.film);
        renderer.drawSample(this.film, this.appearance, positions[this.nextSample]);
        renderer.accumulate(this.film, 1 / positions.length);
        this.nextSample += 1;
        if (this.nextSample < positions.length) return this.requestFrame();
        this.show(this.film.sum);
        this.nextSample = 0;
    }

    adaptResolution(time) {
        const elapsed = time - this.lastDraftTime;
        this.lastDraftTime = time;
        this.consecutiveDrafts = elapsed > 400 ? 0 : this.consecutiveDrafts + 1;
        if (this.consecutiveDrafts < 3) return;  // the first ones may include compiling shaders and filling buffers
        if (elapsed > SLOW_FRAME_MS) this.resolutionScale = Math.max(0.25, this.resolutionScale * 0.8);
        else if (elapsed < FAST_FRAME_MS) this.resolutionScale = Math.min(1, this.resolutionScale * 1.05);
    }
}
