;;; emacs.el --- Keyline's graph files in Emacs  -*- lexical-binding: t; -*-
;; SPDX-FileCopyrightText: 2026 The Keyline Authors
;; SPDX-License-Identifier: Apache-2.0
;;
;; Starts `keyline lsp' by Eglot for graph files: JSON that has a "keyline" in its first lines.  Other JSON is left alone.
;;
;;     (load "/path/to/keyline/editors/emacs.el")
;;
;; in init.el, where Eglot is installed (of Emacs 29 it is a part).  $KEYLINE is the program, where it is not in $PATH.

(require 'eglot)

(define-derived-mode keyline-mode js-mode "Keyline"
  "A graph of Keyline: JSON in which comments are allowed."
  (setq-local indent-tabs-mode nil
              js-indent-level 2))

(add-to-list 'magic-mode-alist '("\\`[^\"]*{[^{}]*\"keyline\"[ \t\n]*:" . keyline-mode))
(add-to-list 'eglot-server-programs `(keyline-mode . (,(or (getenv "KEYLINE") "keyline") "lsp")))
(add-hook 'keyline-mode-hook #'eglot-ensure)

(provide 'keyline)
;;; emacs.el ends here
