import { element } from "../../../../sdk/web/elements.js";
import { Gestures } from "../../../../sdk/web/gestures.js";
import { readScene } from "../../../../sdk/web/scene.js";
import { Picture } from "./picture.js";

/** The interactive picture. */
class Page {
    constructor() {
        this.scene = readScene();
        this.canvas = document.getElementById("picture-canvas");
        this.picture = new Picture(this.scene, this.canvas);
        this.seen = this.scene.observer;
        this.request = 0;
        this.picture.draw(this.seen);
        // Read by `candela verify` from the document that a headless browser prints.
        if (location.hash === "#verify") document.body.append(element("pre", { id: "picture", hidden: true }, this.canvas.toDataURL("image/png")));
        new Gestures(this.canvas, this, () => this.moveObserver(this.scene.observer));
        this.canvas.addEventListener("webglcontextrestored", () => this.redraw());
    }

    observer() {
        return this.seen;
    }

    moveObserver(observer) {
        this.seen = observer;
        this.redraw();
    }

    /** Runs once before the screen is next drawn. */
    redraw() {
        if (this.request !== 0) return;
        this.request = requestAnimationFrame(() => {
            this.request = 0;
            this.picture.draw(this.seen);
        });
    }

    /** Rows of RGBA bytes, from the top. */
    pixels() {
        const { width, height } = this.canvas, context = new OffscreenCanvas(width, height).getContext("2d", { alpha: false });
        this.picture.draw(this.seen);
        context.drawImage(this.canvas, 0, 0);
        return context.getImageData(0, 0, width, height).data;
    }
}

const opened = (async () => new Page())();

/** For scripts: `ready` resolves when the page works, or rejects with the reason; the others are promises of what their names say. */
window.candela = {
    ready: opened.then(() => {}),
    page: opened,
    render: async () => (await opened).pixels(),
};

opened.catch((error) => {
    const text = [error.message, error.detail].filter(Boolean).join("\n");
    // Also read by `candela verify`.
    document.body.append(element("pre", { id: "problem", role: "alert" }, text));
});
