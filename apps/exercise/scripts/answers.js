/** The file of an answer, which `candela exercise grade` reads. */
export function answerText({ model, function: name }, body) {
    return `${JSON.stringify({ candela_exercise: 1, model, function: name, answer: body.split("\n") }, null, 2)}\n`;
}

/** The body in an answer's file. Throws for what is none, or is about something else. */
export function bodyOf(exercise, text) {
    let answer;
    try {
        answer = JSON.parse(text);
    } catch {
        answer = null;
    }
    if (answer?.candela_exercise !== 1 || !Array.isArray(answer.answer)) throw new Error("This file is no answer to an exercise.");
    if (answer.model !== exercise.model || answer.function !== exercise.function) throw new Error(`This is an answer to another exercise: ${answer.function} of ${answer.model}.`);
    return answer.answer.join("\n");
}
