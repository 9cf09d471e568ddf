// All tests of the page, in one browser.
import './page.test.mjs';
import './view.test.mjs';
import './access.test.mjs';
import './newcomer.test.mjs';
import './code.test.mjs';
