import { element } from "../../../../sdk/web/elements.js";
import { FromOutside } from "./from_outside.js";
import { Markers } from "./markers.js";
import { Panes } from "./panes.js";
import { SHOWN } from "./parameters.js";

const TITLES = { lights: "Lights", room: "Room", axes: "Axes", observer: "From outside" };

/** The display in addition to the scene's picture: lights, room and axes over it, and other pictures next to it. */
export class Display {
    /** `bounds`: returns the objects' boxes; `setOthers`: gets the other views in Viewport's form; null if there can be none. */
    constructor({ settings, picture, controls, bounds, onReset, setOthers }) {
        Object.assign(this, { settings, bounds, setOthers, container: picture.parentElement });
        this.markers = new Markers({ settings, picture, observer: () => settings.observer(), bounds });
        const isAlone = setOthers === null;
        this.boxes = SHOWN.filter(({ name }) => !isAlone || name !== "observer").map(({ name }) => {
            const box = element("input", { type: "checkbox", id: `show-${name}` });
            box.addEventListener("change", () => {
                settings.set(`show.${name}`, box.checked);
                settings.notify(`show.${name}`);
            });
            document.getElementById("shown").append(element("label", {}, box, ` ${TITLES[name]}`));
            return [name, box];
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
            if (path === null || path.startsWith("show.")) this.refresh();
        });
    }

    refresh() {
        for (const [name, box] of this.boxes) box.checked = this.settings.get(`show.${name}`);
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
