;;; probe.el  -*- lexical-binding: t; -*-
;; SPDX-FileCopyrightText: 2026 The Keyline Authors
;; SPDX-License-Identifier: Apache-2.0
;; What Emacs shows of $GRAPH: a line for each diagnostic.  Without a screen no command ends, after which Eglot would start
;; by itself.

(defun probe-wait (done)
  (let ((end (+ (float-time) 60)))
    (while (and (< (float-time) end) (not (funcall done))) (accept-process-output nil 0.1))))

(find-file (getenv "GRAPH"))
(message "mode: %s" major-mode)
(apply #'eglot--connect (eglot--guess-contact))
(probe-wait (lambda () (and (eglot-managed-p) (> (length (flymake-diagnostics)) 1))))
(dolist (found (flymake-diagnostics))
  (message "told: %d: %s" (line-number-at-pos (flymake-diagnostic-beg found)) (flymake-diagnostic-text found)))
(find-file (getenv "OTHER"))
(message "other: %s" major-mode)
(kill-emacs 0)
