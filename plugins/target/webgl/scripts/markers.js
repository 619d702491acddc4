import { project } from "./arrows.js";
import { viewAxes, viewHeight } from "../../../../sdk/web/camera.js";
import { element, isolated, newId, svgElement } from "../../../../sdk/web/elements.js";
import { ballAround, lightPlaces } from "./light_places.js";
import { announce } from "./messages.js";
import { seenPlaces } from "./occlusion.js";
import { layOver, onMoved } from "./overlay.js";
import { roundToFloat } from "../../../../sdk/web/values.js";
import { add, dot, scale, subtract } from "../../../../sdk/web/vectors.js";
import { boxLines, drawLines, drawWord, viewLines } from "./wires.js";

const MARGIN = 14;         // from the picture's border, in CSS pixels, for lights outside of it
const KEY_STEP = 1 / 50;   // relative to the visible height of the plane in which a light is moved
const AXES = [["x", [1, 0, 0]], ["y", [0, 1, 0]], ["z", [0, 0, 1]]];

const numbers = (vector) => roundToFloat(vector).join(", ");

/** The visible height in the plane through a point that faces the observer. */
function heightAt(observer, point) {
    if (observer.projection === "orthographic") return viewHeight(observer);
    const depth = Math.abs(dot(viewAxes(observer).forward, subtract(point, observer.position)));
    return Math.max(depth, 1e-3) * viewHeight(observer);
}

/** A point's position in the picture, in picture heights from its centre; points outside are put at a margin from the border. */
function placeInPicture(observer, aspect, margin, point) {
    const { right, up } = viewAxes(observer), from = subtract(point, observer.position);
    const inside = project(observer, point), { x, y } = inside ?? { x: dot(right, from), y: -dot(up, from) };
    const isOutside = inside === null || Math.abs(x) > aspect / 2 || Math.abs(y) > 0.5;
    if (!isOutside) return { x, y, isOutside };
    const beyond = Math.max(Math.abs(x) / (aspect / 2 - margin), Math.abs(y) / (0.5 - margin)) || 1;
    return { x: x / beyond, y: y / beyond, isOutside };
}

/**
 * The lights of a picture as handles that can be dragged or moved with keys in the plane that faces the observer; with their
 * cones and directions, the room's edges, the axes and the observer as lines. They change the same settings as the sliders.
 */
export class Markers {
    /**
     * `picture`: the canvas that it covers; `observer`: returns the observer; `bounds`: returns the objects' boxes;
     * `isFromOutside`: the picture is not the view of the scene's observer.
     */
    constructor({ settings, picture, observer, bounds, isFromOutside = false }) {
        Object.assign(this, { settings, picture, observer, bounds, isFromOutside });
        this.buttons = new Map();
        this.seen = new Map();
        this.how = element("p", { id: newId("markers-how"), class: "unseen" },
            "Drag it or use the arrow keys; Page Up and Page Down move it away and nearer; hold Shift for small steps.");
        this.layer = element("div", { class: "markers" });
        picture.after(this.layer);
        this.endMoves = onMoved(this.layer, picture, () => this.refresh());
        this.listener = () => this.refresh();
        settings.listeners.push(this.listener);
        this.refresh();
    }

    release() {
        const { listeners } = this.settings;
        listeners.splice(listeners.indexOf(this.listener), 1);
        this.endMoves();
        this.layer.remove();
    }

    refresh() {
        const { scene } = this.settings, { width, height } = scene.image, observer = this.observer();
        layOver(this.layer, this.picture);
        this.places = this.settings.get("show.lights") ? lightPlaces(this.settings, this.bounds()) : [];
        this.drawWires(observer, [width, height]);
        const wanted = new Set(), margin = Math.min(0.25, MARGIN / Math.max(1, this.picture.getBoundingClientRect().height));
        for (const place of this.places) {
            const spots = place.handles.map(({ at }) => placeInPicture(observer, width / height, margin, at));
            // A light outside the picture is one handle at the border.
            const count = spots.every(({ isOutside }) => isOutside) ? 1 : spots.length;
            place.handles.slice(0, count).forEach((handle, i) => {
                const key = `${place.index} ${handle.part}`;
                wanted.add(key);
                this.showHandle(key, place, handle, spots[i], width / height);
            });
        }
        for (const [key, button] of this.buttons) {
            if (wanted.has(key)) continue;
            button.remove();
            this.buttons.delete(key);
        }
        // No element exists unless it is needed.
        const parts = [this.wires, this.buttons.size > 0 ? this.how : null].filter((part) => part !== null);
        for (const part of [this.how, this.layer.querySelector("svg")]) {
            if (part && !parts.includes(part)) part.remove();
        }
        for (const part of parts) this.layer.prepend(part);
    }

    drawWires(observer, size) {
        const { settings } = this, { room } = settings.scene, drawn = [];
        if (settings.get("show.room") && room.some((extent) => extent > 0)) drawn.push(...drawLines(observer, size, boxLines(room), "room"));
        if (settings.get("show.axes")) {
            const reach = 0.5 * ballAround(this.bounds()).radius;
            for (const [name, axis] of AXES) {
                const end = scale(axis, reach);
                drawn.push(...drawLines(observer, size, [[[0, 0, 0], end]], `axis-${name}`), ...drawWord(observer, size, end, name, `axis-${name}`));
            }
        }
        if (this.isFromOutside) {
            const own = settings.observer();
            drawn.push(...drawLines(observer, size, viewLines(own, size[0] / size[1]), "observer"), ...drawWord(observer, size, own.position, "observer", "observer"));
        }
        for (const { lines, isOn } of this.places) drawn.push(...drawLines(observer, size, lines, isOn ? "light" : "light off"));
        this.wires = drawn.length === 0 ? null : svgElement("svg", { "aria-hidden": "true", viewBox: `0 0 ${size[0]} ${size[1]}`, preserveAspectRatio: "none" }, ...drawn);
    }

    /** `spot`: its position in the picture. */
    showHandle(key, place, handle, { x, y, isOutside }, aspect) {
        if (!this.buttons.has(key)) this.makeButton(key, handle.part);
        const button = this.buttons.get(key);
        const isHidden = !isOutside && this.seen.get(key) === false;
        button.current = { place, handle };
        Object.assign(button.style, { left: `${100 * (0.5 + x / aspect)}%`, top: `${100 * (0.5 + y)}%` });
        button.style.setProperty("--light", place.color);
        button.classList.toggle("off", !place.isOn);
        button.classList.toggle("outside", isOutside);
        button.classList.toggle("behind", isHidden);
        button.classList.toggle("right", x > aspect / 6);  // its name has room to the left
        if (handle.part === "position" || place.handles.length === 1) button.querySelector(".marker-name").replaceChildren(isolated(place.name));
        const states = [place.isOn ? "" : "off", isOutside ? "outside the picture" : "", isHidden ? "behind an object" : ""];
        const what = `${handle.part} ${numbers(this.settings.get(handle.path))}`;
        button.setAttribute("aria-label", [place.name, place.title, what, ...states].filter((part) => part !== "").join(", "));
    }

    makeButton(key, part) {
        const button = element("button", { type: "button", class: `marker ${part}`, "aria-describedby": this.how.id },
            element("span", { class: "marker-name" }));
        this.buttons.set(key, button);
        this.layer.append(button);
        let drag = null;
        button.addEventListener("pointerdown", (event) => {
            if (event.button !== 0 || !event.isPrimary) return;
            button.setPointerCapture(event.pointerId);
            button.classList.add("held");
            const { handle } = button.current;
            drag = { handle, from: [event.clientX, event.clientY], value: this.settings.get(handle.path), hasMoved: false };
        });
        button.addEventListener("pointermove", (event) => {
            if (drag === null) return;
            const height = this.picture.getBoundingClientRect().height, [x, y] = drag.from;
            drag.hasMoved ||= Math.hypot(event.clientX - x, event.clientY - y) > 2;
            if (drag.hasMoved) this.move(drag.handle, (event.clientX - x) / height, (event.clientY - y) / height, 0, 1 / height);
        });
        let wasDragged = false;
        for (const end of ["pointerup", "pointercancel"]) {
            button.addEventListener(end, () => {
                wasDragged = drag?.hasMoved ?? false;
                drag = null;
                button.classList.remove("held");
            });
        }
        button.addEventListener("click", () => {
            if (!wasDragged) this.openControls(button.current.place.index);
            wasDragged = false;
        });
        button.addEventListener("keydown", (event) => {
            if (event.key === "Escape" && drag !== null) {
                this.change(drag.handle.path, drag.value);
                drag = null;
            } else {
                this.key(event, button);
            }
        });
        // The wheel also zooms over a light.
        button.addEventListener("wheel", (event) => {
            event.preventDefault();
            this.picture.dispatchEvent(new WheelEvent("wheel", event));
        }, { passive: false });
    }

    key(event, button) {
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        const ways = { ArrowLeft: [-1, 0, 0], ArrowRight: [1, 0, 0], ArrowUp: [0, -1, 0], ArrowDown: [0, 1, 0], PageUp: [0, 0, 1], PageDown: [0, 0, -1] };
        const way = ways[event.key];
        if (!way) return;
        event.preventDefault();
        const step = event.shiftKey ? KEY_STEP / 5 : KEY_STEP, { handle, place } = button.current;
        this.move(handle, ...way.map((part) => part * step), step / 10);
        announce(`${place.name}: ${handle.part} ${numbers(this.settings.get(handle.path))}`);
    }

    /** Moves it right, down and away by fractions of the picture's height; `precision`: of its new position, as such a fraction. */
    move(handle, x, y, away, precision) {
        const observer = this.observer(), { forward, right, up } = viewAxes(observer), height = heightAt(observer, handle.at);
        const by = add(scale(right, x * height), add(scale(up, -y * height), scale(forward, away * height)));
        this.change(handle.path, roundToFloat(handle.valueAt(add(handle.at, by), 10 ** Math.floor(Math.log10(precision * height)))));
    }

    change(path, value) {
        if (this.settings.validate(path, value) !== null) return;
        this.settings.set(path, value);
        this.settings.notify(path);
    }

    openControls(index) {
        const details = document.querySelectorAll("#lights details")[index];
        details.open = true;
        details.scrollIntoView({ block: "nearest" });
    }

    /** Called after a picture has been drawn; marks each light that is behind an object. */
    async lookBehind(renderer, film) {
        // A direction's handle has no real place.
        const looked = this.places.flatMap((place) => place.handles.filter(({ part }) => part === "position").map((handle) => [`${place.index} ${handle.part}`, handle.at]));
        if (looked.length === 0) return;
        const seen = await seenPlaces(renderer, film, this.observer(), looked.map(([, at]) => at));
        const isNew = looked.some(([key], i) => this.seen.get(key) !== seen[i]);
        looked.forEach(([key], i) => this.seen.set(key, seen[i]));
        if (isNew) this.refresh();
    }
}
