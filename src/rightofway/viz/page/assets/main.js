import { payloadOf } from "./common/dom.js";
import { createPlayer } from "./player/player.js";

createPlayer(document.body, payloadOf(document));
