// The page itself: from the scene to something that can be looked at and changed.

class Page {
    start() {
        this.scene = readScene();
        document.querySelector("h1").textContent = this.scene.title;
        document.getElementById("maker").textContent = `Made by Candela ${this.scene.candela}`;
        this.settings = new Settings(this.scene);
        this.canvas = document.getElementById("picture-canvas");
        const options = { alpha: false, antialias: false, depth: false, powerPreference: "high-performance" };
        this.gl = this.canvas.getContext("webgl2", options);
        if (this.gl === null) {
            throw new Error(
                "This page needs WebGL 2, which this browser does not offer. It may be switched off in its settings, or the " +
                "graphics driver may be too old; a current Firefox, Chrome, Edge or Safari should do.");
        }
        const isVerification = location.hash === "#verify";
        const notice = restore(this.settings, location.hash);
        this.renderer = new Renderer(this.gl, this.scene);
        this.renderer.prepare(appearanceOf(this.settings));
        if (isVerification) this.showPicture();
        else this.open(notice);
    }

    pixels(width, height) {
        for (const length of [width, height]) {
            if (!Number.isInteger(length) || length < 1) throw new Error("A picture's width and height are whole numbers from 1.");
        }
        if (this.gl.isContextLost()) throw new Error("The graphics have been interrupted.");
        return this.renderer.pixels(appearanceOf(this.settings), width, height);
    }

    showPicture() {
        const { width, height } = this.scene.image;
        const png = pngOf(this.pixels(width, height), width, height);
        document.body.append(element("pre", { id: "picture", hidden: true }, png));
    }

    open(notice) {
        const { settings, scene } = this;
        document.getElementById("room").style.setProperty("--proportion", scene.image.width / scene.image.height);
        const resetView = () => document.getElementById("reset-view").click();
        new Panels(settings, new Controls(settings, reachOf(scene, this.renderer.boxes))).build();
        new Gestures(this.canvas, settings, resetView);
        connectActions(settings, async (width, height) => this.pixels(width, height));
        this.openStage();
        showNotice(notice);
        addEventListener("hashchange", () => showNotice(restore(settings, location.hash)));
        this.canvas.addEventListener("webglcontextlost", (event) => {
            event.preventDefault();
            this.stage.stop();
            showProblem(new Error("The graphics have been interrupted; the picture comes back when they do."));
        });
        this.canvas.addEventListener("webglcontextrestored", () => {
            this.renderer = new Renderer(this.gl, scene);
            this.openStage();
        });
        document.body.classList.add("open");
    }

    openStage() {
        const { canvas, renderer, settings } = this;
        this.stage = new Stage({ canvas, renderer, settings, room: document.getElementById("room"), onProblem: showProblem });
    }
}

function startPage() {
    const page = new Page();
    const ready = (async () => page.start())();
    window.candela = {
        ready,
        render: async (width, height) => {
            await ready;
            return page.pixels(width, height);
        },
    };
    ready.catch((problem) => {
        document.body.classList.add("failed");
        showProblem(problem);
        const text = [problem.message, problem.detail].filter(Boolean).join("\n");
        document.body.append(element("pre", { id: "problem", hidden: true }, text));
    });
}

startPage();
