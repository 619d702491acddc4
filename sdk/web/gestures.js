import { orbit, zoom } from "./camera.js";
import { length, subtract } from "./vectors.js";

const KEY_ANGLE = Math.PI / 36;
const KEY_FACTOR = 1.1;

/** Orbits and zooms by dragging, pinching, the wheel and keys. */
export class Gestures {
    /** `onReset`: called for the keys 0 and Home. */
    constructor(canvas, settings, onReset) {
        this.canvas = canvas;
        this.settings = settings;
        this.onReset = onReset;
        this.pointers = new Map();
        canvas.addEventListener("pointerdown", (event) => this.down(event));
        canvas.addEventListener("pointermove", (event) => this.move(event));
        for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (event) => this.up(event));
        canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
        canvas.addEventListener("keydown", (event) => this.key(event));
    }

    orbit(azimuth, elevation) {
        this.settings.moveObserver(orbit(this.settings.observer(), azimuth, elevation));
    }

    /** Within limits, beyond which nothing would be visible. */
    zoom(factor) {
        const initial = this.settings.scene.observer, moved = zoom(this.settings.observer(), factor);
        const viewSize = (o) => (o.projection === "orthographic" ? o.height : length(subtract(o.position, o.look_at)));
        const ratio = viewSize(moved) / viewSize(initial);
        if (ratio > 0.005 && ratio < 200) this.settings.moveObserver(moved);
    }

    down(event) {
        if (event.pointerType === "mouse" && event.button !== 0) return;
        this.canvas.setPointerCapture(event.pointerId);
        this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
        this.canvas.classList.add("held");
    }

    pointerDistance() {
        const [[ax, ay], [bx, by]] = this.pointers.values();
        return Math.hypot(ax - bx, ay - by);
    }

    move(event) {
        const from = this.pointers.get(event.pointerId);
        if (!from) return;
        const distance = this.pointers.size === 2 ? this.pointerDistance() : 0;
        this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
        if (this.pointers.size === 1) {
            const anglePerPixel = Math.PI / Math.min(this.canvas.clientWidth, this.canvas.clientHeight);
            this.orbit((from[0] - event.clientX) * anglePerPixel, (event.clientY - from[1]) * anglePerPixel);
        } else if (distance > 0) {
            this.zoom(distance / Math.max(this.pointerDistance(), 1));
        }
    }

    up(event) {
        this.pointers.delete(event.pointerId);
        if (this.pointers.size === 0) this.canvas.classList.remove("held");
    }

    wheel(event) {
        event.preventDefault();
        const pixels = event.deltaY * [1, 16, 400][event.deltaMode];
        this.zoom(Math.exp(Math.max(-200, Math.min(200, pixels)) * 0.0015));
    }

    key(event) {
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        const angle = event.shiftKey ? KEY_ANGLE / 5 : KEY_ANGLE;
        const actions = new Map(Object.entries({
            ArrowLeft: () => this.orbit(-angle, 0),
            ArrowRight: () => this.orbit(angle, 0),
            ArrowUp: () => this.orbit(0, angle),
            ArrowDown: () => this.orbit(0, -angle),
            "+": () => this.zoom(1 / KEY_FACTOR),
            "=": () => this.zoom(1 / KEY_FACTOR),
            "-": () => this.zoom(KEY_FACTOR),
            "0": this.onReset,
            Home: this.onReset,
        }));
        const action = actions.get(event.key);
        if (!action) return;
        event.preventDefault();
        action();
    }
}
