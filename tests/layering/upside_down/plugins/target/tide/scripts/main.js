import { pull } from "../../../light/pull.js";
