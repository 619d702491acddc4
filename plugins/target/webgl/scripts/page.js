import { connectActions, connectSaving, pngUrl } from "./actions.js";
import { appearanceOf } from "./appearance.js";
import { Controls } from "./controls.js";
import { Display } from "./display.js";
import { element } from "../../../../sdk/web/elements.js";
import { Explanation } from "./explanation.js";
import { FormulaEditor } from "./formulas/formula_editor.js";
import { unusedOf, withFormulas } from "./formulas/formulas.js";
import { Gestures } from "../../../../sdk/web/gestures.js";
import { restoreSettings } from "./link.js";
import { CorePicture } from "./core_picture.js";
import { followScene, isServed } from "./live.js";
import { showError, showNotice } from "./messages.js";
import { boxOf } from "../../../../sdk/web/vertex_arrays.js";
import { Panels } from "./panels.js";
import { Renderer } from "./renderer.js";
import { Reference } from "./reference.js";
import { readScene } from "../../../../sdk/web/scene.js";
import { Settings } from "./settings.js";
import { sliderExtent } from "./sliders.js";
import { Viewport } from "./viewport.js";

/** The page, from the scene in its HTML to a picture that can be looked at and changed. */
export class Page {
    /** Throws if the page cannot work, for example without WebGL 2, unless `candela view` provides a picture instead. */
    start() {
        this.scene = readScene();
        document.querySelector("h1").textContent = this.scene.title;
        document.getElementById("maker").textContent = `Made by Candela ${this.scene.candela}`;
        this.settings = new Settings(this.scene);
        this.formulas = new Map();  // edited kernel texts, by model
        this.container = document.getElementById("viewport");
        this.canvas = document.getElementById("picture-canvas");
        const options = { alpha: false, antialias: false, depth: false, powerPreference: "high-performance" };
        this.gl = this.canvas.getContext("webgl2", options);
        if (this.gl === null && !isServed()) {
            throw new Error(
                "This page needs WebGL 2, which this browser does not offer. It may be switched off in the settings, or the " +
                "graphics driver may be too old; a current Firefox, Chrome, Edge or Safari should work.");
        }
        const isVerification = location.hash === "#verify";
        const notice = restoreSettings(this.settings, location.hash);
        this.renderer = null;
        if (this.gl !== null) {
            this.renderer = new Renderer(this.gl, this.scene);
            this.renderer.prepare(appearanceOf(this.settings));
        }
        if (isVerification) this.appendPicture();
        else this.open(notice);
    }

    /** Rows of RGBA bytes, from the top; a promise of them without WebGL 2. */
    pixels(width, height) {
        for (const size of [width, height]) {
            if (!Number.isInteger(size) || size < 1) throw new Error("A picture's width and height must be whole numbers of at least 1.");
        }
        if (this.renderer === null) return this.viewport.pixels(width, height);
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
        this.controls = new Controls(settings, sliderExtent(this.scene, this.bounds()));
        this.panels = new Panels(settings, this.controls);
        this.panels.build();
        new Gestures(this.canvas, settings, resetView);
        connectActions(settings, async (width, height) => this.pixels(width, height));
        this.display = new Display({
            settings, picture: this.canvas, controls: this.controls, bounds: () => this.bounds(), onReset: resetView,
            setOthers: this.renderer === null ? null : (views) => this.setOthers(views),
        });
        this.renderer === null ? this.openCorePicture() : this.openViewport();
        showNotice(notice);
        addEventListener("hashchange", () => showNotice(restoreSettings(settings, location.hash)));
        this.canvas.addEventListener("webglcontextlost", (event) => {
            event.preventDefault();
            this.viewport.stop();
            showError(new Error("The graphics have been interrupted; the picture returns when they do."));
        });
        this.canvas.addEventListener("webglcontextrestored", () => {
            this.renderer = new Renderer(this.gl, withFormulas(this.scene, this.formulas));
            this.openViewport();
        });
        document.body.classList.add("open");
        const isLive = followScene((scene) => this.show(scene), showError);
        this.formulaEditor = this.renderer === null ? null : new FormulaEditor(this, isLive);
        if (isLive) {
            connectSaving(settings);
            if (this.renderer !== null) this.reference = new Reference(settings, this.canvas, (width, height) => this.pixels(width, height));
            this.explanation = new Explanation(settings, this.canvas, () => this.renderer);
        }
    }

    setProportion() {
        this.container.style.setProperty("--proportion", this.scene.image.width / this.scene.image.height);
    }

    /**
     * Replaces the scene by another state, keeping the view and the changes made here but not in the scene. Throws if it cannot
     * be drawn; then everything stays as it is.
     */
    show(scene) {
        if (this.renderer !== null) this.replaceRenderer(scene);
        this.scene = scene;
        document.title = scene.title;
        document.querySelector("h1").textContent = scene.title;
        this.setProportion();
        this.settings.replaceScene(scene);
        this.controls.extent = sliderExtent(scene, this.bounds());
        this.display.rebuild();
        this.viewport.use(this.renderer);
        this.panels.rebuild();
        this.reference?.invalidate();
        this.explanation.clear();
        this.formulaEditor?.sceneChanged();
    }

    /** Replaces the renderer by one that draws another scene. Throws if that fails, and keeps the present one. */
    replaceRenderer(scene) {
        if (this.gl.isContextLost()) throw new Error("The graphics have been interrupted.");
        const settings = this.settings.continuedIn(scene);
        let renderer;
        try {
            renderer = this.rendererOf(scene, this.formulas, settings);
        } catch (error) {
            if (this.formulas.size === 0) throw error;
            renderer = this.rendererOf(scene, new Map(), settings);
            this.formulas = new Map();
            showNotice("The edited formula no longer fits the scene's models; the scene is shown without it.");
        }
        this.renderer.release();
        this.renderer = renderer;
    }

    /** The boxes around the objects. */
    bounds() {
        return this.renderer?.bounds ?? this.scene.objects.map(boxOf);
    }

    openCorePicture() {
        const { canvas, container, settings } = this;
        this.viewport = new CorePicture({ canvas, container, settings, onError: showError });
        document.getElementById("without-graphics").hidden = false;
    }

    /** A renderer of a scene with edited formulas, in addition to the present one. Throws if it cannot draw the settings' picture. */
    rendererOf(scene, formulas, settings) {
        const renderer = new Renderer(this.gl, withFormulas(scene, formulas), this.renderer);
        try {
            const appearance = appearanceOf(settings);
            renderer.prepare(appearance, unusedOf(appearance, formulas.keys()));
        } catch (error) {
            renderer.release();
            throw error;
        }
        return renderer;
    }

    /** Draws with these formulas from now on. Throws if they do not compile; then everything stays as it is. */
    drawWith(formulas) {
        if (this.gl.isContextLost()) throw new Error("The graphics have been interrupted.");
        const renderer = this.rendererOf(this.scene, formulas, this.settings);
        this.renderer.release();
        this.renderer = renderer;
        this.viewport.use(renderer);
    }

    /** Like drawWith(), and makes the formulas the page's. */
    useFormulas(formulas) {
        this.drawWith(formulas);
        this.formulas = formulas;
    }

    /** Like pixels(), with other formulas. */
    pixelsWith(formulas, width, height) {
        const renderer = this.rendererOf(this.scene, formulas, this.settings);
        try {
            return renderer.pixels(appearanceOf(this.settings), width, height);
        } finally {
            renderer.release();
        }
    }

    openViewport() {
        const { canvas, container, display, renderer, settings } = this;
        this.viewport = new Viewport({
            canvas, container, renderer, settings, onError: showError,
            onDraft: (film) => display.markers.lookBehind(this.renderer, film),
        });
        this.viewport.setOthers(this.others);
    }

    setOthers(views) {
        this.others = views;
        this.viewport?.setOthers(views);
    }
}
