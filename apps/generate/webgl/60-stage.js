// The picture on the screen: quick and coarse while something moves, with all samples once it rests.

const REST_MS = 140;           // without a change before the picture is refined
const SLOW_FRAME_MS = 50;      // a moving picture that takes longer gets fewer pixels
const QUICK_FRAME_MS = 24;
const MOST_PIXELS = 2560 * 1600;

class Stage {
    /// `room`: the element whose box the canvas fits into; `onProblem` is told of errors.
    constructor({ canvas, room, renderer, settings, onProblem }) {
        Object.assign(this, { canvas, room, renderer, settings, onProblem });
        this.coarseness = 1;
        this.film = null;
        this.frame = 0;
        this.timer = 0;
        this.lastMove = 0;
        this.moves = 0;  // one soon after the other
        this.sample = -1;  // next of the refinement; -1: the quick picture
        this.observer = new ResizeObserver(() => this.changed());
        this.observer.observe(room);
        settings.listeners.push(() => this.changed());
        this.changed();
    }

    stop() {
        this.observer.disconnect();
        cancelAnimationFrame(this.frame);
        clearTimeout(this.timer);
        this.isStopped = true;
    }

    changed() {
        if (this.isStopped) return;
        this.appearance = null;
        this.sample = -1;
        clearTimeout(this.timer);
        this.request();
    }

    request() {
        if (this.frame === 0) this.frame = requestAnimationFrame((time) => this.step(time));
    }

    /// CSS pixels that the picture takes, in the scene's proportions.
    size() {
        const { width, height } = this.settings.scene.image;
        const box = this.room.getBoundingClientRect();
        const scale = Math.min(box.width / width, box.height / height);
        return [Math.max(1, Math.floor(width * scale)), Math.max(1, Math.floor(height * scale))];
    }

    /// A film as large as the picture is shown, or coarser.
    prepareFilm(coarseness) {
        const [width, height] = this.size();
        this.canvas.style.width = `${width}px`;
        this.canvas.style.height = `${height}px`;
        const ratio = Math.min(devicePixelRatio || 1, Math.sqrt(MOST_PIXELS / (width * height))) * coarseness;
        const pixels = [width, height].map((length) => Math.max(1, Math.round(length * ratio)));
        if (this.film && this.film.width === pixels[0] && this.film.height === pixels[1]) return;
        this.film?.release();
        this.film = null;
        this.film = this.renderer.film(...pixels);
    }

    show(target) {
        // A canvas that gets another size is black until it is drawn to, so both happen at once.
        if (this.canvas.width !== this.film.width) this.canvas.width = this.film.width;
        if (this.canvas.height !== this.film.height) this.canvas.height = this.film.height;
        this.renderer.encode(target, null);
    }

    step(time) {
        this.frame = 0;
        try {
            this.sample < 0 ? this.move(time) : this.refine();
        } catch (problem) {
            this.onProblem(problem);
        }
    }

    /// One sample at once; the rest when nothing changes any more.
    move(time) {
        this.adapt(time);
        this.appearance = appearanceOf(this.settings);
        this.renderer.prepare(this.appearance);
        this.prepareFilm(this.coarseness);
        this.renderer.drawSample(this.film, this.appearance, CENTRE);
        this.show(this.film.picture);
        this.onProblem(null);
        this.sample = 0;
        this.timer = setTimeout(() => this.request(), REST_MS);
    }

    refine() {
        const { renderer } = this, positions = this.settings.scene.image.sample_positions;
        this.prepareFilm(1);
        if (this.sample === 0) renderer.clearSum(this.film);
        renderer.drawSample(this.film, this.appearance, positions[this.sample]);
        renderer.accumulate(this.film, 1 / positions.length);
        this.sample += 1;
        if (this.sample < positions.length) return this.request();
        this.show(this.film.sum);
        this.sample = 0;
    }

    adapt(time) {
        const elapsed = time - this.lastMove;
        this.lastMove = time;
        this.moves = elapsed > 400 ? 0 : this.moves + 1;
        if (this.moves < 3) return;  // shaders and buffers may have been made in between
        if (elapsed > SLOW_FRAME_MS) this.coarseness = Math.max(0.25, this.coarseness * 0.8);
        else if (elapsed < QUICK_FRAME_MS) this.coarseness = Math.min(1, this.coarseness * 1.05);
    }
}
