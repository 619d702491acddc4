// A control for a setting. Each is an element of class "setting" with a method `refresh`, which shows the setting's value.

const AXES = ["x", "y", "z"];
const CHANNELS = ["red", "green", "blue"];

class Controls {
    constructor(settings, reach) {
        this.settings = settings;
        this.reach = reach;
    }

    /// Wraps inputs: a name, what it means, what is wrong with what was put in.
    row(path, title, inputs, { refresh, isGroup = false }) {
        const { parameter } = this.settings.find(path);
        const problem = element("p", { class: "wrong", id: newId("wrong"), role: "alert" });
        const meaning = element("p", { class: "meaning", id: newId("meaning") }, parameter.meaning);
        const caption = element(isGroup ? "div" : "label", { class: "name", id: newId("name") }, label(title));
        if (parameter.unit !== "") caption.append(element("span", { class: "unit" }, parameter.unit));
        const result = element(
            "div",
            { class: `setting ${parameter.type}`, "data-path": path, role: isGroup ? "group" : null, "aria-labelledby": isGroup ? caption.id : null },
            caption, ...inputs, parameter.meaning === "" ? null : meaning, problem,
        );
        const named = [...result.querySelectorAll("input, select")];
        if (!isGroup) {
            named[0].id ||= newId("input");
            caption.htmlFor = named[0].id;
        }
        for (const input of named) {
            if (parameter.meaning !== "") input.setAttribute("aria-describedby", `${meaning.id} ${problem.id}`);
            else input.setAttribute("aria-describedby", problem.id);
        }
        result.refresh = () => {
            problem.textContent = "";
            for (const input of named) input.removeAttribute("aria-invalid");
            refresh(this.settings.get(path));
            result.classList.toggle("changed", this.settings.changes.has(path));
        };
        result.take = (value, input) => {
            const wrong = this.settings.change(path, value);
            problem.textContent = wrong === null ? "" : `${title} ${wrong}.`;
            wrong === null ? input.removeAttribute("aria-invalid") : input.setAttribute("aria-invalid", "true");
            result.classList.toggle("changed", this.settings.changes.has(path));
        };
        result.refresh();
        return result;
    }

    /// A slider and a number field that show one number; `take` gets it. The first input is the number field.
    numberPair(parameter, { low, high, step }, name, take) {
        const number = element("input", {
            type: "number", step: parameter.type === "integer" ? "1" : "any", inputMode: "decimal", "aria-label": name,
            min: parameter.minimum === null ? "" : tidy(parameter.minimum),
            max: parameter.maximum === null ? "" : tidy(parameter.maximum),
        });
        const slider = element("input", { type: "range", min: low, max: high, step, "aria-label": name && `${name}, slider` });
        const fill = () => slider.style.setProperty("--filled", `${(100 * (slider.value - low)) / (high - low)}%`);
        number.addEventListener("input", () => {
            const value = number.value.trim() === "" ? NaN : Number(number.value);
            if (isNumber(value)) slider.value = value;
            fill();
            take(value, number);
        });
        slider.addEventListener("input", () => {
            number.value = tidy(Number(slider.value));
            number.removeAttribute("aria-invalid");
            fill();
            take(tidy(Number(slider.value)), slider);
        });
        const show = (value) => {
            number.value = slider.value = value;
            fill();
        };
        return { number, slider, show };
    }

    scalar(path, title) {
        const { parameter, own } = this.settings.find(path);
        const pair = this.numberPair(parameter, sliderRange(parameter, own), null, (value, input) => row.take(value, input));
        const row = this.row(path, title, [pair.number, pair.slider], { refresh: pair.show });
        pair.slider.setAttribute("aria-label", `${title}, slider`);
        return row;
    }

    /// Three numbers below one another.
    vector(path, title, names) {
        const { parameter, own } = this.settings.find(path);
        const pairs = names.map((name, axis) =>
            this.numberPair(parameter, sliderRange(parameter, own, axis, this.reach), `${title} ${name}`, (value, input) =>
                row.take(this.settings.get(path).with(axis, value), input)));
        const lines = pairs.map(({ number, slider }, axis) =>
            element("div", { class: `line ${names[axis]}` }, element("span", { class: "axis", "aria-hidden": "true" }, names[axis][0]), number, slider));
        const row = this.row(path, title, lines, {
            isGroup: true,
            refresh: (value) => pairs.forEach((pair, axis) => pair.show(value[axis])),
        });
        return row;
    }

    /// One number for all channels, until somebody wants three or the scene has three.
    triple(path, title) {
        const { parameter, own } = this.settings.find(path);
        const isGrey = ([r, g, b]) => r === g && g === b;
        const holder = element("div", { class: "triple-holder" });
        const split = element("button", { type: "button", class: "split", "aria-label": `${title}: one number for each channel` }, "rgb");
        const build = (isOne) => {
            const pair = (name, take) => this.numberPair(parameter, sliderRange(parameter, own), name, take);
            let row;
            if (isOne) {
                const one = pair(null, (value, input) => row.take([value, value, value], input));
                row = this.row(path, title, [one.number, one.slider], { refresh: ([value]) => one.show(value) });
                one.slider.setAttribute("aria-label", `${title}, slider`);
            } else {
                row = this.vector(path, title, CHANNELS);
            }
            const showsOne = isOne;
            const refresh = row.refresh;
            row.refresh = () => (showsOne && !isGrey(this.settings.get(path)) ? build(false) : refresh());
            split.setAttribute("aria-pressed", String(!isOne));
            row.querySelector(".name").after(split);
            holder.replaceChildren(row);
        };
        split.addEventListener("click", () => {
            const isOne = split.getAttribute("aria-pressed") === "true";
            const [first] = this.settings.get(path);
            if (isOne && !isGrey(this.settings.get(path))) this.settings.change(path, [first, first, first]);
            build(isOne);
            split.focus();
        });
        build(isGrey(this.settings.get(path)));
        return holder;
    }

    color(path, title) {
        const input = element("input", { type: "color" });
        const numbers = element("output", { class: "numbers" });
        input.addEventListener("input", () => {
            row.take(colorOf(input.value), input);
            numbers.textContent = colorOf(input.value).join(" ");
        });
        const row = this.row(path, title, [input, numbers], {
            refresh: (value) => {
                input.value = hexOf(value);
                numbers.textContent = value.join(" ");
            },
        });
        numbers.htmlFor = input.id;
        return row;
    }

    choice(path, title, textOf = (choice) => choice) {
        const { parameter } = this.settings.find(path);
        const select = element("select", {}, ...parameter.choices.map((choice) => element("option", { value: choice }, textOf(choice))));
        select.addEventListener("change", () => row.take(select.value, select));
        const row = this.row(path, title, [select], { refresh: (value) => (select.value = value) });
        return row;
    }

    boolean(path, title) {
        const input = element("input", { type: "checkbox" });
        input.addEventListener("change", () => row.take(input.checked, input));
        const row = this.row(path, title, [input], { refresh: (value) => (input.checked = value) });
        return row;
    }

    /// The control for what stands at a path, by its type; null where there is nothing.
    of(path, title) {
        const found = this.settings.find(path);
        if (found === null) return null;
        switch (found.parameter.type) {
            case "real":
            case "integer":
                return this.scalar(path, title);
            case "boolean":
            case "choice":
            case "color":
            case "rgb":
                return this[found.parameter.type](path, title);
            default:
                return this.vector(path, title, AXES);
        }
    }
}
