import { connectActions, connectSaving, pngUrl } from "./actions.js";
import { appearanceOf } from "./appearance.js";
import { Controls } from "./controls.js";
import { element } from "./elements.js";
import { Explanation } from "./explanation.js";
import { Gestures } from "./gestures.js";
import { restoreSettings } from "./link.js";
import { followScene } from "./live.js";
import { showError, showNotice } from "./messages.js";
import { Panels } from "./panels.js";
import { Renderer } from "./renderer.js";
import { Reference } from "./reference.js";
import { readScene } from "./scene.js";
import { Settings } from "./settings.js";
import { sliderExtent } from "./sliders.js";
import { Viewport } from "./viewport.js";

/** The page, from the scene in its HTML to a picture that can be looked at and changed. */
export class Page {
    /** Throws where the page cannot work, for want of WebGL 2 for one. */
    start() {
        this.scene = readScene();
        document.querySelector("h1").textContent = this.scene.title;
        document.getElementById("maker").textContent = `Made by Candela ${this.scene.candela}`;
        this.settings = new Settings(this.scene);
        this.container = document.getElementById("viewport");
        this.canvas = document.getElementById("picture-canvas");
        const options = { alpha: false, antialias: false, depth: false, powerPreference: "high-performance" };
        this.gl = this.canvas.getContext("webgl2", options);
        if (this.gl === null) {
            throw new Error(
                "This page needs WebGL 2, which this browser does not offer. It may be switched off in its settings, or the " +
                "graphics driver may be too old; a current Firefox, Chrome, Edge or Safari should do.");
        }
        const isVerification = location.hash === "#verify";
        const notice = restoreSettings(this.settings, location.hash);
        this.renderer = new Renderer(this.gl, this.scene);
        this.renderer.prepare(appearanceOf(this.settings));
        if (isVerification) this.appendPicture();
        else this.open(notice);
    }

    /** Rows of RGBA bytes, from the top. */
    pixels(width, height) {
        for (const size of [width, height]) {
            if (!Number.isInteger(size) || size < 1) throw new Error("A picture's width and height are whole numbers from 1.");
        }
        if (this.gl.isContextLost()) throw new Error("The graphics have been interrupted.");
        return this.renderer.pixels(appearanceOf(this.settings), width, height);
    }

    /** For `candela verify`, which reads the picture from the document that a headless browser prints. */
    appendPicture() {
        const { width, height } = this.scene.image;
        const png = pngUrl(this.pixels(width, height), width, height);
        document.body.append(element("pre", { id: "picture", hidden: true }, png));
    }

    open(notice) {
        const { settings } = this;
        this.setProportion();
        const resetView = () => document.getElementById("reset-view").click();
        this.controls = new Controls(settings, sliderExtent(this.scene, this.renderer.bounds));
        this.panels = new Panels(settings, this.controls);
        this.panels.build();
        new Gestures(this.canvas, settings, resetView);
        connectActions(settings, async (width, height) => this.pixels(width, height));
        this.openViewport();
        showNotice(notice);
        addEventListener("hashchange", () => showNotice(restoreSettings(settings, location.hash)));
        this.canvas.addEventListener("webglcontextlost", (event) => {
            event.preventDefault();
            this.viewport.stop();
            showError(new Error("The graphics have been interrupted; the picture comes back when they do."));
        });
        this.canvas.addEventListener("webglcontextrestored", () => {
            this.renderer = new Renderer(this.gl, this.scene);
            this.openViewport();
        });
        document.body.classList.add("open");
        if (followScene((scene) => this.show(scene), showError)) {
            connectSaving(settings);
            this.reference = new Reference(settings, this.canvas, (width, height) => this.pixels(width, height));
            this.explanation = new Explanation(settings, this.canvas, () => this.renderer);
        }
    }

    setProportion() {
        this.container.style.setProperty("--proportion", this.scene.image.width / this.scene.image.height);
    }

    /**
     * Another state of the scene in place of the present one, from where it is looked at, with what has been changed here and
     * not in the scene. Throws where it cannot be drawn; then everything stays as it is.
     */
    show(scene) {
        if (this.gl.isContextLost()) throw new Error("The graphics have been interrupted.");
        const renderer = new Renderer(this.gl, scene, this.renderer);
        try {
            renderer.prepare(appearanceOf(this.settings.continuedIn(scene)));
        } catch (error) {
            renderer.release();
            throw error;
        }
        this.renderer.release();
        Object.assign(this, { scene, renderer });
        document.title = scene.title;
        document.querySelector("h1").textContent = scene.title;
        this.setProportion();
        this.settings.replaceScene(scene);
        this.controls.extent = sliderExtent(scene, renderer.bounds);
        this.panels.rebuild();
        this.viewport.use(renderer);
        this.reference.invalidate();
        this.explanation.clear();
    }

    openViewport() {
        const { canvas, container, renderer, settings } = this;
        this.viewport = new Viewport({ canvas, container, renderer, settings, onError: showError });
    }
}
