export module candela.light;

import candela.files;
