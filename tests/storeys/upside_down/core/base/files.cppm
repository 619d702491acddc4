export module candela.files;

import candela.light;
