import { orbit } from "../../../../sdk/web/camera.js";
import { element } from "../../../../sdk/web/elements.js";
import { Gestures } from "../../../../sdk/web/gestures.js";
import { ballAround, lightPlaces } from "./light_places.js";
import { Markers } from "./markers.js";
import { add, length, normalize, scale, subtract } from "../../../../sdk/web/vectors.js";

const FOV = 40;  // degrees
const AZIMUTH = 0.9, ELEVATION = 0.35;  // from the observer's direction, in radians

/** An observer who sees the objects, the lights and the scene's observer from outside. */
function outsider(settings, bounds) {
    const own = settings.observer(), { width, height } = settings.scene.image;
    const points = [own.position, ...lightPlaces(settings, bounds).flatMap(({ handles }) => handles.map(({ at }) => at))];
    const { centre, radius } = ballAround([...bounds, ...points.map((point) => ({ low: point, high: point }))]);
    const distance = (1.05 * radius * Math.max(1, height / width)) / Math.sin((FOV * Math.PI) / 360);
    const back = subtract(own.position, centre), way = length(back) > 1e-6 ? normalize(back) : normalize(subtract(own.position, own.look_at));
    const start = { up: own.up, projection: "perspective", fov: FOV, look_at: centre, position: add(centre, scale(way, distance)) };
    return orbit(start, AZIMUTH, ELEVATION);
}

/** The scene and its observer from outside, next to the other pictures: the observer's view, as lines, and the lights. */
export class FromOutside {
    constructor({ settings, bounds, container }) {
        Object.assign(this, { settings, bounds });
        this.canvas = element("canvas", { id: "outside-canvas", role: "img" });
        container.append(this.canvas);
        this.reset();
        // A gesture turns only this view.
        const view = { scene: { observer: this.observer }, observer: () => this.observer, moveObserver: (observer) => this.turn(observer) };
        new Gestures(this.canvas, view, () => this.turn(outsider(settings, bounds())));
        this.markers = new Markers({ settings, picture: this.canvas, observer: () => this.observer, bounds, isFromOutside: true });
        this.view = { canvas: this.canvas, settings: settings.seenBy(() => this.observer) };
        this.tell = () => {
            const { position, look_at } = settings.observer();
            this.canvas.setAttribute("aria-label", `The scene from outside; the observer is at ${position.join(", ")} and looks at ${look_at.join(", ")}`);
        };
        this.tell();
        settings.listeners.push(this.tell);
    }

    reset() {
        this.observer = outsider(this.settings, this.bounds());
    }

    turn(observer) {
        this.observer = observer;
        this.settings.notify("show.observer");
    }

    release() {
        const { listeners } = this.settings;
        listeners.splice(listeners.indexOf(this.tell), 1);
        this.markers.release();
        this.canvas.remove();
    }
}
