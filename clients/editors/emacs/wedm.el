;;; wedm.el --- DXF, 3B and wire ISO with the language server wedm  -*- lexical-binding: t -*-

;; In init.el:
;;
;;   (load "/path/to/wedm/clients/editors/emacs/wedm.el")
;;   (setq wedm-settings '(:correction 0.12))
;;
;; Emacs 28 needs the package eglot (Debian: elpa-eglot); Emacs 29 and later have it built in.

;;; Code:

(require 'eglot)

(defgroup wedm nil
  "Drawings and programs of wire erosion."
  :group 'languages)

(defcustom wedm-program "wedm"
  "The language server: a file, or a name on the PATH or in ~/.cargo/bin."
  :type 'string)

(defcustom wedm-settings nil
  "Settings as a property list, as in (:correction 0.12 :side \"opening\").
A wedm.toml above a file wins over them."
  :type 'plist)

(define-derived-mode dxf-mode text-mode "DXF"
  "Drawings as DXF text."
  (setq-local require-final-newline nil)
  ;; Trailing blanks and line ends are part of the file.
  (auto-fill-mode -1))

(define-derived-mode three-b-mode prog-mode "3B"
  "Programs of wire cutting controllers in the format 3B."
  (setq-local comment-start "; "))

(define-derived-mode wire-iso-mode prog-mode "Wire ISO"
  "ISO programs of wire cutting machines."
  (setq-local comment-start "; "))

;; The server's names of the languages.
(put 'dxf-mode 'eglot-language-id "dxf")
(put 'three-b-mode 'eglot-language-id "3b")
(put 'wire-iso-mode 'eglot-language-id "wire-iso")

(add-to-list 'auto-mode-alist '("\\.[dD][xX][fF]\\'" . dxf-mode))
(add-to-list 'auto-mode-alist '("\\.[34][bB]\\'" . three-b-mode))
(add-to-list 'auto-mode-alist '("\\.\\(?:iso\\|ISO\\|nc\\|NC\\)\\'" . wire-iso-mode))

(defun wedm--program ()
  "The file of the server, or nil.
A desktop often starts Emacs with another PATH than a shell has, so it is
also looked for where `cargo install' puts it."
  (or (executable-find wedm-program)
      (let ((exec-path (list (expand-file-name "~/.cargo/bin"))))
        (executable-find wedm-program))))

(defun wedm--contact (&rest _)
  "The command that starts the server, with the settings."
  (let ((program (or (wedm--program) wedm-program)))
    (if wedm-settings
        (list program :initializationOptions wedm-settings)
      (list program))))

(add-to-list 'eglot-server-programs '((dxf-mode three-b-mode wire-iso-mode) . wedm--contact))

(defun wedm-ensure ()
  "Start the server for this buffer, or say how to get it."
  (if (wedm--program)
      (eglot-ensure)
    (message "wedm: %s is neither on the PATH nor in ~/.cargo/bin; build it in a checkout of wedm with `cargo install --path .', or set `wedm-program'"
             wedm-program)))

(dolist (hook '(dxf-mode-hook three-b-mode-hook wire-iso-mode-hook))
  (add-hook hook #'wedm-ensure))

(defun wedm-fix-all ()
  "Make every repair of this buffer that is safe."
  (interactive)
  (eglot-code-actions (point-min) (point-max) "source.fixAll.wedm" t))

(provide 'wedm)
;;; wedm.el ends here
