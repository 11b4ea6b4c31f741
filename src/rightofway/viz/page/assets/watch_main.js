import { payloadOf } from "./dom.js";
import { createPlayer } from "./player.js";
import { WATCHING } from "./watching.js";

createPlayer(document.body, payloadOf(document), WATCHING);
