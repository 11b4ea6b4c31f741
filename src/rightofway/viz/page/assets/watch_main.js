import { payloadOf } from "./common/dom.js";
import { createPlayer } from "./player/player.js";
import { WATCHING } from "./live/watching.js";

createPlayer(document.body, payloadOf(document), WATCHING);
