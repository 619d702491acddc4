import { element } from "../../../../sdk/web/elements.js";
import { FromOutside } from "./from_outside.js";
import { Markers } from "./markers.js";
import { Panes } from "./panes.js";
import { SHADOWS_PATH, SHOWN } from "./parameters.js";

const TITLES = { shadows: "Shadows", lights: "Lights", room: "Room", axes: "Axes", observer: "From outside" };

/** The display in addition to the scene's picture: lights, room and axes over it, and other pictures next to it. */
export class Display {
    /** `bounds`: returns the objects' boxes; `setOthers`: gets the other views in Viewport's form; null if there can be none. */
    constructor({ settings, picture, controls, bounds, onReset, setOthers }) {
        Object.assign(this, { settings, bounds, setOthers, container: picture.parentElement });
        this.markers = new Markers({ settings, picture, observer: () => settings.observer(), bounds });
        const isAlone = setOthers === null;
        const shown = SHOWN.filter(({ name }) => !isAlone || name !== "observer").map(({ name }) => [name, `show.${name}`]);
        this.boxes = [["shadows", SHADOWS_PATH], ...shown].map(([name, path]) => {
            const box = element("input", { type: "checkbox", id: `show-${name}` });
            box.addEventListener("change", () => {
                settings.set(path, box.checked);
                settings.notify(path);
            });
            document.getElementById("shown").append(element("label", {}, box, ` ${TITLES[name]}`));
            return [path, box];
        });
        this.outside = null;
        this.paneViews = [];
        this.refresh();
        document.getElementById("display").hidden = false;
        for (const part of document.querySelectorAll("#display > :not(#shown)")) part.hidden ||= isAlone;
        this.panes = isAlone ? null : new Panes({
            settings, picture, controls, onReset,
            change: (views) => {
                this.paneViews = views;
                this.arrange();
            },
        });
        settings.listeners.push((path) => {
            if (path === null || path === SHADOWS_PATH || path.startsWith("show.")) this.refresh();
        });
    }

    refresh() {
        for (const [path, box] of this.boxes) {
            // Scenes come and go, with and without shadows.
            box.parentElement.hidden = this.settings.find(path) === null;
            if (!box.parentElement.hidden) box.checked = this.settings.get(path);
        }
        const isWanted = this.setOthers !== null && this.settings.get("show.observer");
        if (isWanted === (this.outside !== null)) return;
        this.outside?.release();
        this.outside = isWanted ? new FromOutside(this) : null;
        this.arrange();
    }

    arrange() {
        this.setOthers([...this.paneViews, ...(this.outside === null ? [] : [this.outside.view])]);
    }

    /** Called after another scene has arrived. */
    rebuild() {
        this.outside?.release();
        this.outside = null;
        this.refresh();
        this.markers.refresh();
        this.panes?.arrange();
    }
}
