import { appearanceOf } from "./appearance.js";
import { AdaptiveResolution } from "./resolution.js";

const REFINEMENT_DELAY_MS = 140;
const MAX_PIXELS = 2560 * 1600;
const PIXEL_CENTER = [0.5, 0.5];
const GAP = 8;  // between pictures, in CSS pixels

/**
 * Keeps the canvases up to date: one sample per pixel while something changes, at a lower resolution if frames are slow; all
 * samples once nothing changes. A frame begins when the graphics have finished the previous one, so that none queue up.
 *
 * There may be several views of the scene. All are drawn in one context, whose canvas shows the first of them; the pictures of the
 * others are copied from it.
 */
export class Viewport {
    /**
     * `container`: the element that the pictures are fitted into. `onError` gets an error, or null after a successful frame; `onDraft`
     * is called with the first view's film when its picture has been drawn.
     */
    constructor({ canvas, container, renderer, settings, onError, onDraft = () => {} }) {
        Object.assign(this, { canvas, container, renderer, settings, onError, onDraft });
        this.resolution = new AdaptiveResolution();
        this.views = [{ canvas, settings, films: {}, film: null }];
        this.isDrawing = false;
        this.frameRequest = 0;
        this.refinementTimer = 0;
        this.resizeObserver = new ResizeObserver(() => this.invalidate());
        this.resizeObserver.observe(container);
        settings.listeners.push(() => this.invalidate());
        this.invalidate();
    }

    /** Further views, next to the first or over it: { canvas, settings, isOver } each. */
    setOthers(others) {
        for (const { films } of this.views.slice(1)) Object.values(films).forEach((film) => film.release());
        this.views = [this.views[0], ...others.map((view) => ({ ...view, films: {}, film: null, context: view.canvas.getContext("2d", { alpha: false }) }))];
        this.invalidate();
    }

    stop() {
        this.resizeObserver.disconnect();
        cancelAnimationFrame(this.frameRequest);
        clearTimeout(this.refinementTimer);
        this.isStopped = true;
    }

    /** Draws with another renderer of the same context from now on, starting at once so that the graphics work in parallel with the page. */
    use(renderer) {
        this.renderer = renderer;
        this.invalidate();
        if (this.isDrawing || this.isStopped) return;
        cancelAnimationFrame(this.frameRequest);
        this.drawFrame();
    }

    /** Starts again with a draft at the next frame. */
    invalidate() {
        if (this.isStopped) return;
        this.startRefinement(false);
        clearTimeout(this.refinementTimer);
        this.requestFrame();
    }

    /** The first view's picture stays in the context's canvas, so it is refined last. */
    startRefinement(hasDraft) {
        this.unfinished = hasDraft ? [...this.views.slice(1), this.views[0]] : null;  // null: a draft comes first
        this.nextSample = 0;
        this.nextBand = 0;  // of that sample
    }

    requestFrame() {
        if (this.frameRequest === 0 && !this.isDrawing) this.frameRequest = requestAnimationFrame(() => this.drawFrame());
    }

    /** The number of pictures in a row that makes them as large as possible, and the size of each in CSS pixels. */
    layout() {
        const { width, height } = this.settings.scene.image, box = this.container.getBoundingClientRect();
        const count = this.views.filter(({ isOver }) => !isOver).length;
        let best = { ratio: 0, columns: 1 };
        for (let columns = 1; columns <= count; ++columns) {
            const rows = Math.ceil(count / columns);
            const ratio = Math.min((box.width - GAP * (columns - 1)) / (columns * width), (box.height - GAP * (rows - 1)) / (rows * height));
            if (ratio > best.ratio) best = { ratio, columns };
        }
        return { columns: best.columns, size: [width, height].map((side) => Math.max(1, Math.floor(side * best.ratio))) };
    }

    /** Overlays follow their pictures when they move. */
    tellArrangement() {
        const arrangement = JSON.stringify([this.layout(), this.views.length]);
        if (arrangement === this.arrangement) return;
        this.arrangement = arrangement;
        this.container.dispatchEvent(new Event("arranged"));
    }

    /**
     * Gives a view a film of its size on the screen, times `resolutionScale`. The films of drafts and of finished pictures are
     * both kept, since they alternate, and a browser waits for the graphics when one is made.
     */
    prepareFilm(view, resolutionScale) {
        const { columns, size: [width, height] } = this.layout();
        this.container.style.setProperty("--columns", columns);
        view.canvas.style.width = `${width}px`;
        view.canvas.style.height = `${height}px`;
        const most = MAX_PIXELS / this.views.length;
        const ratio = Math.min(devicePixelRatio || 1, Math.sqrt(most / (width * height))) * resolutionScale;
        const pixels = [width, height].map((size) => Math.max(1, Math.round(size * ratio)));
        const { films } = view, kind = resolutionScale < 1 ? "draft" : "finished";
        view.film = films[kind] ?? null;
        if (view.film && view.film.width === pixels[0] && view.film.height === pixels[1] && this.renderer.fits(view.film)) return;
        view.film?.release();
        delete films[kind];
        view.film = null;
        view.film = films[kind] = this.renderer.createFilm(...pixels);
    }

    /** Puts a film's target into the context's canvas. */
    encode({ film, target, appearance }) {
        // Resizing clears the canvas, so it is drawn in the same frame.
        if (this.canvas.width !== film.width) this.canvas.width = film.width;
        if (this.canvas.height !== film.height) this.canvas.height = film.height;
        this.renderer.encode(target, null, appearance);
    }

    show(view, target) {
        view.shown = { film: view.film, target, appearance: view.appearance };
        this.encode(view.shown);
        if (!view.context) return;
        const { width, height } = view.film;
        if (view.canvas.width !== width) view.canvas.width = width;
        if (view.canvas.height !== height) view.canvas.height = height;
        view.context.drawImage(this.canvas, 0, 0);
        const [first] = this.views;
        if (first.shown) this.encode(first.shown);
    }

    drawFrame() {
        this.frameRequest = 0;
        try {
            this.unfinished === null ? this.drawDraft() : this.refine();
        } catch (error) {
            this.onError(error);
        }
    }

    drawDraft() {
        for (const view of this.views) {
            view.appearance = appearanceOf(view.settings);
            this.renderer.prepare(view.appearance);
            view.shown = null;
        }
        const start = performance.now();
        for (const view of this.views.toReversed()) {
            this.prepareFilm(view, this.resolution.scale);
            this.renderer.drawSample(view.film, view.appearance, PIXEL_CENTER);
            this.show(view, view.film.picture);
        }
        this.tellArrangement();
        this.onDraft(this.views[0].film);
        this.onError(null);
        this.startRefinement(true);
        this.whenFinished(() => {
            this.resolution.adapt(performance.now() - start);
            if (this.unfinished === null) this.requestFrame();
            else this.refinementTimer = setTimeout(() => this.requestFrame(), REFINEMENT_DELAY_MS);
        });
    }

    /** Draws a band of a sample. */
    refine() {
        const { renderer } = this, { bands } = this.resolution, positions = this.settings.scene.image.sample_positions;
        const [view] = this.unfinished;
        this.prepareFilm(view, 1);
        const { film } = view, [bottom, top] = [this.nextBand, this.nextBand + 1].map((k) => Math.round((k * film.height) / bands));
        if (this.nextSample === 0 && this.nextBand === 0) renderer.clearSum(film);
        renderer.drawSample(film, view.appearance, positions[this.nextSample], [bottom, top]);
        this.nextBand += 1;
        if (this.nextBand === bands) {
            renderer.accumulate(film, 1 / positions.length);
            this.nextBand = 0;
            this.nextSample += 1;
        }
        if (this.nextSample === positions.length) {
            this.show(view, film.sum);
            this.unfinished.shift();
            this.nextSample = 0;
        }
        this.whenFinished(() => {
            if (this.unfinished === null || this.unfinished.length > 0) this.requestFrame();
        });
    }

    /** Calls back when the graphics have finished the frame; no other begins until then. */
    whenFinished(callback) {
        this.isDrawing = true;
        this.renderer.whenFinished(() => {
            this.isDrawing = false;
            if (!this.isStopped) callback();
        });
    }
}
