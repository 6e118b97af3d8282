;;; session.el --- One session as a user has it  -*- lexical-binding: t -*-

;; Opens the drawing given, waits for its fault, takes the offered fix, sees it clean, saves; then undoes, kills the server and sees
;; the fault again from the one that is started in its place.
;; Writes one line for each thing seen to the file WEDM_SEEN; a line that begins with FAIL ends the session with an error.

;;; Code:

(defun session-say (&rest words)
  "Write the formatted WORDS as a line."
  (write-region (concat (apply #'format words) "\n") nil (getenv "WEDM_SEEN") t 'quiet))

(defun session-wait (what condition)
  "Wait until CONDITION holds; WHAT is named when it does not."
  (let ((end (+ (float-time) 90)))
    (while (and (not (funcall condition)) (< (float-time) end))
      (sit-for 0.05))
    (unless (funcall condition)
      (session-say "FAIL no %s within 90 s" what)
      (kill-emacs 1))))

(defun session-faults ()
  "The errors that flymake shows in this buffer."
  (seq-filter (lambda (one) (eq (flymake-diagnostic-type one) 'eglot-error)) (flymake-diagnostics)))

(defun session-undo ()
  "Undo; after an undo this brings back what was undone."
  (undo-boundary)
  (let (last-command this-command)
    (undo)))

(defun session ()
  "What a user does."
  (find-file (getenv "WEDM_DRAWING"))
  ;; What eglot leaves for the end of a command is done here.
  (run-hooks 'post-command-hook)
  (session-wait "server" #'eglot-current-server)
  (session-wait "diagnostic" #'session-faults)
  (session-say "mode: %s" major-mode)
  (let ((fault (car (session-faults))))
    (session-say "diagnostic line %d: %s" (line-number-at-pos (flymake-diagnostic-beg fault)) (flymake-diagnostic-text fault))
    (goto-char (flymake-diagnostic-beg fault)))
  ;; The user picks the first action of the menu.
  (cl-letf (((symbol-function 'completing-read)
             (lambda (_prompt collection &rest _)
               (let ((titles (all-completions "" collection)))
                 (dolist (title titles) (session-say "offered: %s" title))
                 (car titles)))))
    ;; Chosen with the keyboard: no menu of the mouse.
    (let ((last-nonmenu-event ?x))
      (eglot-code-actions (point) (point) "quickfix" t)))
  (session-wait "fix" (lambda () (null (session-faults))))
  (save-buffer)
  (session-say "fixed and written")
  (let ((fixed (buffer-string))
        (first (eglot-current-server)))
    (session-undo)
    (session-wait "fault after undo" #'session-faults)
    (session-undo)
    (unless (equal (buffer-string) fixed) (session-say "FAIL redo gave another text") (kill-emacs 1))
    (session-wait "fix after redo" (lambda () (null (session-faults))))
    ;; Eglot starts a server again that has lived for three seconds.
    (sit-for 3.5)
    (signal-process (jsonrpc--process first) 'SIGKILL)
    (session-undo)
    (session-wait "new server" (lambda () (let ((now (eglot-current-server))) (and now (not (eq now first))))))
    (session-wait "fault from the new server" #'session-faults)
    (session-say "the server was killed and started again: %d fault" (length (session-faults))))
  (set-buffer-modified-p nil)
  (kill-emacs 0))

(load (expand-file-name "wedm.el" (getenv "WEDM_CONFIGURATION")) nil t)
(setq wedm-settings '(:correction 0.1)
      make-backup-files nil
      create-lockfiles nil)
(run-with-timer 0.2 nil
                (lambda ()
                  (condition-case reason
                      (session)
                    (error (session-say "FAIL %S" reason) (kill-emacs 1)))))
;;; session.el ends here
