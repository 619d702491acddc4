export module candela.util;

import candela.api;
