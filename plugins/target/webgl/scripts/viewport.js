import { appearanceOf } from "./appearance.js";
import { AdaptiveResolution } from "./resolution.js";

const REFINEMENT_DELAY_MS = 140;
const MAX_PIXELS = 2560 * 1600;
const PIXEL_CENTER = [0.5, 0.5];

/**
 * Keeps the canvas up to date: one sample per pixel, at a lower resolution where frames are slow, while something changes;
 * all samples once it rests. A frame is begun when the graphics have finished the one before, so that none queue up.
 */
export class Viewport {
    /** `container`: the element that the canvas is fitted into. `onError` gets an error, or null after a successful frame. */
    constructor({ canvas, container, renderer, settings, onError }) {
        Object.assign(this, { canvas, container, renderer, settings, onError });
        this.resolution = new AdaptiveResolution();
        this.film = null;
        this.isDrawing = false;
        this.frameRequest = 0;
        this.refinementTimer = 0;
        this.nextSample = -1;  // of the refinement; -1: a draft comes first
        this.nextBand = 0;     // of that sample
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

    /** From now on, draws with another renderer of the same context. */
    use(renderer) {
        this.renderer = renderer;
        this.invalidate();
    }

    /** Starts anew with a draft, at the next frame. */
    invalidate() {
        if (this.isStopped) return;
        this.appearance = null;
        this.nextSample = -1;
        this.nextBand = 0;
        clearTimeout(this.refinementTimer);
        this.requestFrame();
    }

    requestFrame() {
        if (this.frameRequest === 0 && !this.isDrawing) this.frameRequest = requestAnimationFrame(() => this.drawFrame());
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

    drawFrame() {
        this.frameRequest = 0;
        try {
            this.nextSample < 0 ? this.drawDraft() : this.refine();
        } catch (error) {
            this.onError(error);
        }
    }

    drawDraft() {
        this.appearance = appearanceOf(this.settings);
        this.renderer.prepare(this.appearance);
        const start = performance.now();
        this.prepareFilm(this.resolution.scale);
        this.renderer.drawSample(this.film, this.appearance, PIXEL_CENTER);
        this.show(this.film.picture);
        this.onError(null);
        this.nextSample = 0;
        this.whenFinished(() => {
            this.resolution.adapt(performance.now() - start);
            if (this.nextSample < 0) this.requestFrame();
            else this.refinementTimer = setTimeout(() => this.requestFrame(), REFINEMENT_DELAY_MS);
        });
    }

    /** Draws a band of a sample. */
    refine() {
        const { renderer } = this, { bands } = this.resolution, positions = this.settings.scene.image.sample_positions;
        this.prepareFilm(1);
        const { height } = this.film, [bottom, top] = [this.nextBand, this.nextBand + 1].map((k) => Math.round((k * height) / bands));
        if (this.nextSample === 0 && this.nextBand === 0) renderer.clearSum(this.film);
        renderer.drawSample(this.film, this.appearance, positions[this.nextSample], [bottom, top]);
        this.nextBand += 1;
        if (this.nextBand === bands) {
            renderer.accumulate(this.film, 1 / positions.length);
            this.nextBand = 0;
            this.nextSample += 1;
        }
        const isWhole = this.nextSample === positions.length;
        if (isWhole) this.show(this.film.sum);
        this.whenFinished(() => {
            if (!isWhole || this.nextSample < 0) this.requestFrame();
        });
    }

    /** Calls back when the graphics have finished the frame, until when no other is begun. */
    whenFinished(callback) {
        this.isDrawing = true;
        this.renderer.whenFinished(() => {
            this.isDrawing = false;
            if (!this.isStopped) callback();
        });
    }
}
