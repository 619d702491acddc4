import { queryOf } from "./options.js";

/** Fetches the renderer's own picture of the page's scene from `candela view`. Throws the error that it reports. */
export async function fetchPicture(settings, term = "") {
    const query = [queryOf(settings), term === "" ? "" : `terms=${term}`].filter((part) => part !== "").join("&");
    const response = await fetch(`reference.png?${query}`);
    if (!response.ok) throw new Error((await response.text()).trim());
    return createImageBitmap(await response.blob(), { colorSpaceConversion: "none" });
}

/**
 * The picture of a page without WebGL 2: the renderer's own, which `candela view` renders again after every change. Replaces a
 * Viewport.
 */
export class CorePicture {
    /** `onError` gets an error, or null after a picture has arrived. */
    constructor({ canvas, container, settings, onError }) {
        Object.assign(this, { canvas, container, settings, onError });
        this.context = canvas.getContext("2d", { alpha: false, willReadFrequently: true });
        this.wanted = this.shown = 0;
        this.isFetching = false;
        new ResizeObserver(() => this.fit()).observe(container);
        settings.listeners.push(() => this.invalidate());
        this.invalidate();
    }

    /** Like Viewport: another scene. */
    use() {
        this.invalidate();
    }

    invalidate() {
        this.wanted += 1;
        this.fit();
        if (!this.isFetching) this.update();
    }

    /** One picture at a time; changes made meanwhile appear in the next. */
    async update() {
        this.isFetching = true;
        while (this.shown < this.wanted) {
            const wanted = this.wanted;
            try {
                const picture = await fetchPicture(this.settings);
                Object.assign(this.canvas, { width: picture.width, height: picture.height });
                this.context.drawImage(picture, 0, 0);
                this.onError(null);
            } catch (error) {
                this.onError(error);
            }
            this.shown = wanted;
        }
        this.isFetching = false;
        this.container.dispatchEvent(new Event("arranged"));
    }

    fit() {
        const { width, height } = this.settings.scene.image, box = this.container.getBoundingClientRect();
        const ratio = Math.min(box.width / width, box.height / height);
        const [w, h] = [width, height].map((side) => Math.max(1, Math.floor(side * ratio)));
        Object.assign(this.canvas.style, { width: `${w}px`, height: `${h}px` });
    }

    /** Rows of RGBA bytes, from the top, of the scene's size, once they show the current settings. */
    async pixels(width, height) {
        const { image } = this.settings.scene;
        if (width !== image.width || height !== image.height) throw new Error("Without WebGL 2, only a picture of the scene's own size is available.");
        const picture = await fetchPicture(this.settings);
        const context = new OffscreenCanvas(width, height).getContext("2d", { alpha: false });
        context.drawImage(picture, 0, 0);
        return context.getImageData(0, 0, width, height).data;
    }
}
