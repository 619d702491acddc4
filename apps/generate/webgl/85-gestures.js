// Hands on the picture: dragging, pinching, the wheel, keys.

const KEY_TURN = Math.PI / 36;
const KEY_ZOOM = 1.1;

class Gestures {
    /// `onReset`: what 0 and Home do.
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

    turn(turn, rise) {
        this.settings.moveObserver(orbited(this.settings.observer(), turn, rise));
    }

    /// Not so near or far that nothing would be left to see.
    zoom(factor) {
        const own = this.settings.scene.observer, moved = zoomed(this.settings.observer(), factor);
        const sizeOf = (o) => (o.projection === "orthographic" ? o.height : lengthOf(subtract(o.position, o.look_at)));
        const ratio = sizeOf(moved) / sizeOf(own);
        if (ratio > 0.005 && ratio < 200) this.settings.moveObserver(moved);
    }

    down(event) {
        if (event.pointerType === "mouse" && event.button !== 0) return;
        this.canvas.setPointerCapture(event.pointerId);
        this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
        this.canvas.classList.add("held");
    }

    spread() {
        const [[ax, ay], [bx, by]] = this.pointers.values();
        return Math.hypot(ax - bx, ay - by);
    }

    move(event) {
        const from = this.pointers.get(event.pointerId);
        if (!from) return;
        const spread = this.pointers.size === 2 ? this.spread() : 0;
        this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
        if (this.pointers.size === 1) {
            const perPixel = Math.PI / Math.min(this.canvas.clientWidth, this.canvas.clientHeight);
            this.turn((from[0] - event.clientX) * perPixel, (event.clientY - from[1]) * perPixel);
        } else if (spread > 0) {
            this.zoom(spread / Math.max(this.spread(), 1));
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
        const turn = event.shiftKey ? KEY_TURN / 5 : KEY_TURN;
        const deeds = {
            ArrowLeft: () => this.turn(-turn, 0),
            ArrowRight: () => this.turn(turn, 0),
            ArrowUp: () => this.turn(0, turn),
            ArrowDown: () => this.turn(0, -turn),
            "+": () => this.zoom(1 / KEY_ZOOM),
            "=": () => this.zoom(1 / KEY_ZOOM),
            "-": () => this.zoom(KEY_ZOOM),
            "0": this.onReset,
            Home: this.onReset,
        };
        const deed = member(deeds, event.key);
        if (!deed) return;
        event.preventDefault();
        deed();
    }
}
