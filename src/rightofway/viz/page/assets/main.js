import { payloadOf } from "./dom.js";
import { createPlayer } from "./player.js";

createPlayer(document.body, payloadOf(document));
