;;; wedm in AutoCAD, AutoCAD LT, BricsCAD, ZWCAD and GstarCAD: RMIN, RMINFIX, WEDM3B, WEDM4B, WEDMISO, WEDMVIEW.
;;;
;;; The drawing goes out as DXF, the program wedm reads it, and its answer (`--output lisp`) is a list that AutoLISP reads.
;;; An *item* is one line of that answer: a list whose first element says what it is, (finding (rule . "gap") ...).
;;; A *place* is a point of the world coordinate system. Chinese texts are in wedm-zh.lsp beside this file.

(setq wedm:marks-layer "WEDM_MARKS")    ; wedm never checks nor cuts these two layers
(setq wedm:path-layer "WEDM_PATH")
(setq wedm:patience 120)                ; seconds that an answer may take where the program cannot be waited for
(setq wedm:most-listed 100)             ; of more findings only the number is said; all are marked
(setq wedm:most-handles 300)            ; more of them do not fit into a command line of Windows

;;; Texts: a key and a sentence in which %1, %2 ... stand for what is told.

(setq wedm:texts
  '((no-program . "wedm.exe is not known: put it on the support path, or its path into the environment variable WEDM")
    (where-is-it . "Where is wedm.exe?")
    (program-is-gone . "there is no wedm at %1")
    (no-answer . "wedm did not answer: %1")
    (too-late . "wedm did not answer within %1 s")
    (garbage . "the answer of wedm cannot be read: %1")
    (too-old . "this wedm is too old: a newer one is needed, which knows --output lisp")
    (no-dxf . "the DXF could not be written: %1")
    (failed . "error: %1")
    (nothing-cut . "nothing is cut: %1")
    (against . "against: %1")
    (none-found . "nothing found")
    (found . "%1 found; RMINFIX repairs those with a +")
    (hints . "and %1 that may be as they are meant: WEDMVIEW shows them")
    (line . "%1 %2%3 [%4] %5")
    (more . "... and %1 more")
    (which-one . "Number to zoom to <end>: ")
    (no-such-number . "there is no number %1")
    (nothing-to-repair . "there is nothing that can be repaired safely")
    (repaired . "%1 entities changed; U takes all of it back")
    (left . "left: %1")
    (not-repaired . "not repaired: %1: %2")
    (no-undo . "nothing is repaired while UNDO is switched off: it could not be taken back")
    (undone . "nothing was changed: entity %1 could not be changed (is its layer locked?)")
    (which-side . "Side of the wire, by nesting, in an opening or round a punch [Auto/Opening/Punch] <none>: ")
    (save-program . "Save the program")
    (too-many . "too many entities are selected: at most %1, or none for all")
    (no-file . "no file was chosen, nothing is written")
    (written . "%1: %2 blocks, contours: %3")
    (off-chords . "Chords of the drawing are cut as arcs: at most %1 um from the outline")
    (draw-path . "Draw the wire's path on the layer WEDM_PATH [Yes/No] <No>: ")
    (drawn . "the wire's path is on the layer WEDM_PATH")
    (viewed . "%1 is shown in the browser; WEDMVIEW writes it again")
    (start-again . "%1 is written again; open its page once more [Yes/No] <No>: ")
    (error . "error") (warning . "warning") (information . "information")))

(defun wedm:is-chinese ( / page)
  (and (setq page (getvar "SYSCODEPAGE"))
       (= (strcase page) "ANSI_936")))

;; GBK is what a program under code page 936 reads and shows; elsewhere only ASCII is sure.
(defun wedm:language ()
  (if (and (wedm:is-chinese) (/= (getenv "WEDM_LANG") "en")) "zh" "en"))

(defun wedm:encoding ()
  (if (wedm:is-chinese) "gbk" "ascii"))

;; The Chinese texts are in front of the English ones, so that a text that is missing there is not missing here.
(if (and (= (wedm:language) "zh") (findfile "wedm-zh.lsp"))
  (progn
    (load "wedm-zh.lsp")
    (setq wedm:texts (append wedm:texts-zh wedm:texts))))

(defun wedm:text (key told / text number)
  (setq text (cdr (assoc key wedm:texts))
        number 0)
  (foreach one told
    (setq number (1+ number)
          text (wedm:replaced text (strcat "%" (itoa number)) (wedm:shown one))))
  text)

;; The first `old` in a text becomes `new`, whatever stands in that.
(defun wedm:replaced (text old new / at)
  (if (setq at (vl-string-search old text))
    (strcat (substr text 1 at) new (substr text (+ at 1 (strlen old))))
    text))

(defun wedm:shown (value)
  (cond ((= (type value) 'STR) value)
        ((= (type value) 'INT) (itoa value))
        ((= (type value) 'REAL) (rtos value 2 3))
        (T "")))

(defun wedm:say (key told)
  (princ (strcat "\n" (wedm:text key told)))
  (princ))

;;; One command: system variables are kept and restored, also where it is cancelled or fails.

(setq wedm:kept nil)       ; system variables with their values
(setq wedm:in-group nil)   ; an UNDO group is open

(defun wedm:begin ()
  (setq wedm:kept
    (mapcar '(lambda (name) (cons name (getvar name))) '("CMDECHO" "FILEDIA" "OSMODE" "EXPERT")))
  (setvar "CMDECHO" 0)
  (setvar "FILEDIA" 0)
  (setvar "OSMODE" 0)
  (setvar "EXPERT" 5))

(defun wedm:end ()
  (foreach pair wedm:kept
    (if (cdr pair) (setvar (car pair) (cdr pair))))
  (setq wedm:kept nil)
  (princ))

;; Within *error* newer programs allow `command-s` alone, and older ones know only `command`.
(defun wedm:failed (message)
  (if wedm:in-group
    (progn
      (setq wedm:in-group nil)
      (if command-s (command-s "_.UNDO" "_E") (command "_.UNDO" "_E"))))
  (wedm:end)
  (if (and message (not (member message '("Function cancelled" "quit / exit abort" "console break"))))
    (wedm:say 'failed (list message)))
  (princ))

(defun wedm:can-undo ()
  (= 1 (logand 1 (getvar "UNDOCTL"))))

(defun wedm:begin-group ()
  (if (wedm:can-undo)
    (progn
      (command "_.UNDO" "_BE")
      (setq wedm:in-group T))))

(defun wedm:end-group ()
  (if wedm:in-group
    (progn
      (setq wedm:in-group nil)
      (command "_.UNDO" "_E"))))

;;; The program and its answers.

;; Its path: the environment, the support path, what was kept, what the user says.
(defun wedm:program ( / path)
  (cond ((and (setq path (getenv "WEDM")) (/= path "")) (wedm:there path))
        ((findfile "wedm.exe"))
        ((and (setq path (getcfg "AppData/wedm/program")) (findfile path)) path)
        ((setq path (getfiled (wedm:text 'where-is-it nil) "" "exe" 0))
         (setcfg "AppData/wedm/program" path)
         path)
        (T (wedm:say 'no-program nil) nil)))

(defun wedm:there (path)
  (if (findfile path)
    path
    (progn (wedm:say 'program-is-gone (list path)) nil)))

(defun wedm:quoted (text)
  (strcat "\"" text "\""))

;; The object that runs programs and waits for them; AutoCAD LT has none.
(defun wedm:shell ( / shell)
  (vl-catch-all-apply 'vl-load-com nil)
  (setq shell (vl-catch-all-apply 'vlax-create-object '("WScript.Shell")))
  (if (or (null shell) (vl-catch-all-error-p shell)) nil shell))

;; Runs a command of Windows without a window; where it cannot be waited for, until its result is there.
(defun wedm:run (words result / shell ended waited)
  (if (setq shell (wedm:shell))
    (progn
      (setq ended (vl-catch-all-apply 'vlax-invoke-method (list shell 'Run (strcat "cmd.exe " words) 0 :vlax-true)))
      (vlax-release-object shell)))
  (if (or (null shell) (vl-catch-all-error-p ended))
    (progn
      (startapp "cmd.exe" words)
      (setq waited 0)
      (while (and (not (findfile result)) (< waited (* 4 wedm:patience)))
        (command "_.DELAY" 250)
        (setq waited (1+ waited)))))
  (findfile result))

;; The items of the answer to a command of wedm, or nil after the reason was said. The answer gets its name when it is complete.
(defun wedm:ask (words / program answer part errors items)
  (if (setq program (wedm:program))
    (progn
      (setq answer (vl-filename-mktemp "wedm.lsp")
            part (strcat answer ".part")
            errors (strcat answer ".err"))
      (vl-file-delete answer)
      (if (wedm:run
            (strcat "/d /s /c \"" (wedm:quoted program) " " words
                    " --output lisp --encoding " (wedm:encoding) " --lang " (wedm:language)
                    " > " (wedm:quoted part) " 2> " (wedm:quoted errors)
                    " & move /y " (wedm:quoted part) " " (wedm:quoted answer) " > nul\"")
            answer)
        (setq items (wedm:items answer errors))
        (wedm:say 'too-late (list wedm:patience)))
      (foreach file (list answer part errors)
        (vl-file-delete file))
      (if (wedm:has-failed items) nil items))))

(defun wedm:lines (path / file line lines)
  (if (setq file (open path "r"))
    (progn
      (while (setq line (read-line file))
        (setq lines (cons line lines)))
      (close file)
      (reverse lines))))

;; Each line between the first and the last is an item.
(defun wedm:items (answer errors / lines bad item items)
  (setq lines (wedm:lines answer))
  (cond
    ((null lines) (wedm:said-instead (wedm:lines errors)) nil)
    ((or (/= (car lines) "(") (/= (last lines) ")"))
     (wedm:say 'garbage (list (car lines)))
     nil)
    (T
     (foreach line (cdr lines)
       (if (and (/= line ")") (not bad))
         (progn
           (setq item (vl-catch-all-apply 'read (list line)))
           (if (or (vl-catch-all-error-p item) (not (listp item)))
             (setq bad line)
             (setq items (cons item items))))))
     (if bad
       (progn (wedm:say 'garbage (list bad)) nil)
       (reverse items)))))

;; Of a program without an answer: a wedm from before this form refuses the option that it does not know.
(defun wedm:said-instead (lines)
  (cond ((null lines) (wedm:say 'no-answer '("")))
        ((vl-string-search "--encoding" (car lines)) (wedm:say 'too-old nil))
        (T (wedm:say 'no-answer (list (car lines))))))

(defun wedm:of-kind (kind items)
  (vl-remove-if '(lambda (item) (not (eq (car item) kind))) items))

;; A hint, as each sharp corner is one, is counted and neither listed nor marked.
(defun wedm:is-hint (item)
  (= (wedm:get 'severity item) "hint"))

(defun wedm:faults (items)
  (vl-remove-if 'wedm:is-hint (wedm:of-kind 'finding items)))

(defun wedm:hints (items)
  (vl-remove-if-not 'wedm:is-hint (wedm:of-kind 'finding items)))

(defun wedm:get (key item)
  (cdr (assoc key (cdr item))))

;; True after the failures in an answer were said.
(defun wedm:has-failed (items / failures)
  (setq failures (wedm:of-kind 'failure items))
  (foreach item failures
    (wedm:say 'failed (list (wedm:get 'message item))))
  failures)

;;; The drawing as DXF.

;; Beside the drawing, where its wedm.toml is, under a name that no file of the user has; else in the folder for temporary files.
(defun wedm:dxf ( / name file)
  (setq name (strcat (vl-filename-base (getvar "DWGNAME")) "-wedm.dxf")
        file (wedm:written-as (strcat (getvar "DWGPREFIX") name)))
  (if (null file)
    (setq file (wedm:written-as (strcat (getvar "TEMPPREFIX") name))))
  (if (null file)
    (wedm:say 'no-dxf (list (strcat (getvar "TEMPPREFIX") name))))
  file)

(defun wedm:written-as (path)
  (vl-file-delete path)
  (if (wedm:can-write path)
    (progn
      (command "_.DXFOUT" path "16")
      (findfile path))))

(defun wedm:can-write (path / file)
  (if (setq file (open path "w"))
    (progn
      (close file)
      (vl-file-delete path)
      T)))

;; The handles of a selection set.
(defun wedm:handles (selection / index handles)
  (if selection
    (repeat (setq index (sslength selection))
      (setq index (1- index)
            handles (cons (cdr (assoc 5 (entget (ssname selection index)))) handles))))
  handles)

;;; Marks and lists.

(defun wedm:layer (name colour)
  (command "_.-LAYER" "_N" name "_C" colour name "_ON" name "_T" name "_U" name ""))

(defun wedm:clear (layer / selection index)
  (if (tblsearch "LAYER" layer)
    (command "_.-LAYER" "_U" layer ""))
  (if (setq selection (ssget "_X" (list (cons 8 layer))))
    (repeat (setq index (sslength selection))
      (setq index (1- index))
      (entdel (ssname selection index)))))

;; A circle about a place and its number, of a size that is seen in this view.
(defun wedm:mark (number place radius / size about)
  (setq size (max (/ (getvar "VIEWSIZE") 60.0) (* 3.0 radius))
        place (list (car place) (cadr place) 0.0)
        about (list (cons 8 wedm:marks-layer) '(410 . "Model")))
  (entmake (append '((0 . "CIRCLE")) about (list (cons 10 place) (cons 40 size))))
  (entmake
    (append '((0 . "TEXT")) about
      (list (cons 10 (list (+ (car place) size) (+ (cadr place) size) 0.0)) (cons 40 size) (cons 1 (itoa number))))))

(defun wedm:mark-all (findings / number place)
  (setq number 0)
  (if findings (wedm:layer wedm:marks-layer "6"))
  (foreach item findings
    (setq number (1+ number))
    (if (setq place (wedm:get 'place item))
      (wedm:mark number place (cond ((wedm:get 'radius item)) (T 0.0))))))

(defun wedm:list-all (findings / number)
  (setq number 0)
  (while (and findings (< number wedm:most-listed))
    (setq number (1+ number))
    (wedm:list-one number (car findings))
    (setq findings (cdr findings)))
  (if findings (wedm:say 'more (list (length findings)))))

(defun wedm:list-one (number item)
  (wedm:say 'line
    (list number
          (if (vl-some '(lambda (fix) (cdr (assoc 'safe fix))) (wedm:get 'fixes item)) "+ " "")
          (wedm:text (read (wedm:get 'severity item)) nil)
          (wedm:get 'rule item)
          (wedm:get 'message item))))

;; True for a finding that concerns one of the handles.
(defun wedm:concerns (item handles)
  (or (member (wedm:get 'handle item) handles)
      (vl-some '(lambda (other) (member (cdr (assoc 'handle other)) handles)) (wedm:get 'related item))))

(defun wedm:zoom (findings / number item place)
  (while (setq number (getint (strcat "\n" (wedm:text 'which-one nil))))
    (setq item (if (> number 0) (nth (1- number) findings))
          place (if item (wedm:get 'place item)))
    (if place
      (command "_.ZOOM" "_C" (trans (list (car place) (cadr place) 0.0) 0 1)
        (max 0.001 (* 40.0 (cond ((wedm:get 'radius item)) (T (/ (getvar "VIEWSIZE") 200.0))))))
      (wedm:say 'no-such-number (list number)))))

(defun c:RMIN ( / *error* selection items findings)
  (setq *error* wedm:failed
        selection (wedm:handles (ssget "_I")))
  (wedm:begin)
  (setq items (wedm:ask-anew "check"))
  (if items
    (progn
      (setq findings (wedm:chosen (wedm:faults items) selection))
      (wedm:mark-all findings)
      (wedm:tell-found items findings (wedm:chosen (wedm:hints items) selection))))
  (wedm:end-group)
  (if findings (wedm:zoom findings))
  (wedm:end))

;; The answer about the whole drawing, whose old marks go first; the UNDO group is left open for what comes of it.
(defun wedm:ask-anew (verb / file items)
  (wedm:begin-group)
  (wedm:clear wedm:marks-layer)
  (if (setq file (wedm:dxf))
    (progn
      (setq items (wedm:ask (strcat verb " " (wedm:quoted file))))
      (vl-file-delete file)
      items)))

;; Those of the findings that concern the selection; all where there is none.
(defun wedm:chosen (findings selection)
  (if selection
    (vl-remove-if-not '(lambda (item) (wedm:concerns item selection)) findings)
    findings))

(defun wedm:tell-found (items findings hints)
  (wedm:list-all findings)
  (foreach item (wedm:of-kind 'empty items)
    (wedm:say 'nothing-cut (list (wedm:get 'holds item))))
  (if findings
    (wedm:say 'found (list (length findings)))
    (wedm:say 'none-found nil))
  (if hints (wedm:say 'hints (list (length hints))))
  (foreach item (wedm:of-kind 'file items)
    (wedm:say 'against (list (wedm:get 'said item)))))

;;; Repairs.

;; The groups of a list but those with some codes.
(defun wedm:without (codes groups)
  (vl-remove-if '(lambda (group) (member (car group) codes)) groups))

;; The groups of a list in the place of those with their codes.
(defun wedm:put (fresh groups)
  (foreach group fresh
    (setq groups (subst group (assoc (car group) groups) groups)))
  groups)

;; Gives an entity other geometry. Its other groups stay: layer, colour, elevation, extrusion, data of other programs.
(defun wedm:set-entity (entity groups / kind)
  (setq kind (cdr (assoc 0 groups)))
  (cond
    ((= kind "POLYLINE") (wedm:set-polyline entity groups))
    ((= kind "LWPOLYLINE") (wedm:set-vertices entity groups))
    (T (entmod (wedm:put (cdr groups) (entget entity))))))

;; The vertices take the place of the old ones: behind what is of the whole polyline, before its extrusion.
(defun wedm:set-vertices (entity groups / old extrusion)
  (setq old (entget entity)
        extrusion (assoc 210 old))
  (entmod
    (append
      (wedm:put (list (assoc 90 groups) (assoc 70 groups)) (wedm:without '(43 10 40 41 42 91 210) old))
      (wedm:without '(0 90 70) groups)
      (if extrusion (list extrusion)))))

;; The groups from each code 10 on, as a list for each vertex.
(defun wedm:vertices (groups / vertices)
  (foreach group groups
    (cond ((= (car group) 10) (setq vertices (cons (list group) vertices)))
          (vertices (setq vertices (cons (append (car vertices) (list group)) (cdr vertices))))))
  (reverse vertices))

(defun wedm:records (entity / next records)
  (setq next (entnext entity))
  (while (and next (= (cdr (assoc 0 (entget next))) "VERTEX"))
    (setq records (cons next records)
          next (entnext next)))
  (reverse records))

;; A polyline of VERTEX records: these cannot come or go singly, so that another number of them makes a new polyline.
(defun wedm:set-polyline (entity groups / head flags vertices records)
  (setq head (entget entity)
        flags (assoc 70 groups)
        vertices (wedm:vertices (cddr groups))
        records (wedm:records entity))
  (if (= (length records) (length vertices))
    (and (entmod (wedm:put (list flags) head))
         (not (member nil
                (mapcar '(lambda (record vertex)
                           (entmod (wedm:put vertex (entget record))))
                  records vertices)))
         (progn (entupd entity) T))
    (and (wedm:make-polyline (wedm:put (list flags) (wedm:without '(-1 5 100 102 330 360) head)) vertices)
         (entdel entity))))

(defun wedm:make-polyline (head vertices / common)
  (setq common (list '(0 . "VERTEX") (assoc 8 head)))
  (if (= 8 (logand 8 (cdr (assoc 70 head))))
    (setq common (append common '((70 . 32)))))
  (entmake head)
  (foreach vertex vertices
    (entmake (append common vertex)))
  (entmake (list '(0 . "SEQEND") (assoc 8 head))))

;; A new entity on the layer and in the line type of another: their names need not be in the code page of this program.
(defun wedm:make-new (like groups / looks)
  (setq looks (entget like))
  (entmake
    (append (wedm:without '(8 6 410) groups)
            (vl-remove-if 'null (list (assoc 8 looks) (assoc 6 looks) '(410 . "Model"))))))

;; Makes one change; nil where the drawing does not take it.
(defun wedm:make (item / entity)
  (cond
    ((null (setq entity (handent (cadr item)))) nil)
    ((eq (car item) 'entmake) (wedm:make-new entity (cddr item)))
    ((eq (car item) 'entdel) (entdel entity))
    (T (wedm:set-entity entity (cddr item)))))

;; Makes all changes, up to the first one that the drawing does not take. The handle of that, or nil.
(defun wedm:make-all (changes / refused)
  (foreach item changes
    (if (and (not refused) (not (wedm:make item)))
      (setq refused (cadr item))))
  refused)

(defun c:RMINFIX ( / *error*)
  (setq *error* wedm:failed)
  (wedm:begin)
  (if (wedm:can-undo)
    (wedm:repair)
    (wedm:say 'no-undo nil))
  (wedm:end))

(defun wedm:repair ( / items changes refused left)
  (setq items (wedm:ask-anew "fix")
        changes (vl-remove-if-not '(lambda (item) (member (car item) '(entmod entdel entmake))) items)
        left (wedm:faults items)
        refused (wedm:make-all changes))
  (if (not refused) (wedm:mark-all left))
  (wedm:end-group)
  (cond
    ;; Half of a repair would leave a gap.
    (refused
     (command "_.U")
     (wedm:say 'undone (list refused)))
    (items (wedm:tell-fixed items (length changes) left))))

(defun wedm:tell-fixed (items count left)
  (foreach line (wedm:get 'made (assoc 'fixed items))
    (princ (strcat "\n" line)))
  (if (= count 0)
    (wedm:say 'nothing-to-repair nil)
    (wedm:say 'repaired (list count)))
  (foreach item (wedm:of-kind 'not-repaired items)
    (wedm:say 'not-repaired (list (wedm:get 'message item) (wedm:get 'reason item))))
  (if left (wedm:say 'left (list (length left))))
  (wedm:list-all left))

;;; Programs.

(setq wedm:drawn-kinds '((0 . "LINE,ARC,CIRCLE,LWPOLYLINE,POLYLINE,ELLIPSE,SPLINE")))

(defun wedm:options (format handles side)
  (strcat " --format " format
          (if side (strcat " --side " side) "")
          (apply 'strcat (mapcar '(lambda (handle) (strcat " --handle " handle)) handles))))

;; The items of a program that can be made, with its side where that had to be asked; nil after the reason was said.
(defun wedm:tried (words format handles / items side refused)
  (setq items (wedm:ask (strcat words (wedm:options format handles nil)))
        refused (assoc 'refused items))
  (if (and refused (wedm:get 'side-is-missing refused))
    (progn
      (initget "Auto Opening Punch")
      (if (setq side (getkword (strcat "\n" (wedm:text 'which-side nil))))
        (setq side (strcase side T)
              items (wedm:ask (strcat words (wedm:options format handles side)))
              refused (assoc 'refused items)))))
  (cond ((null items) nil)
        (refused
         (wedm:say 'failed (list (wedm:get 'message refused)))
         (wedm:list-all (wedm:faults items))
         nil)
        (T (cons side items))))

(defun wedm:generate (format / *error* selection dxf)
  (setq *error* wedm:failed
        selection (wedm:handles (ssget "_I" wedm:drawn-kinds)))
  (wedm:begin)
  (cond
    ((> (length selection) wedm:most-handles) (wedm:say 'too-many (list wedm:most-handles)))
    ((setq dxf (wedm:dxf))
     (wedm:generate-from dxf format selection)
     (vl-file-delete dxf)))
  (wedm:end))

(defun wedm:generate-from (dxf format handles / words tried file items program)
  (setq words (strcat "generate " (wedm:quoted dxf))
        tried (wedm:tried words format handles))
  (if tried
    (progn
      (setq file (getfiled (wedm:text 'save-program nil)
                   (strcat (getvar "DWGPREFIX") (vl-filename-base (getvar "DWGNAME"))) format 1))
      (if (null file)
        (wedm:say 'no-file nil)
        (setq items (wedm:ask
                      (strcat words (wedm:options format handles (car tried))
                              " --overwrite -o " (wedm:quoted file)))))))
  (if items
    (progn
      (wedm:list-all (wedm:faults items))
      (if (setq program (assoc 'program items))
        (progn
          (wedm:say 'written (list file (wedm:get 'blocks program) (wedm:get 'contours program)))
          (if (wedm:get 'off-chords program)
            (wedm:say 'off-chords (list (wedm:get 'off-chords program))))
          (initget "Yes No")
          (if (= (getkword (strcat "\n" (wedm:text 'draw-path nil))) "Yes")
            (wedm:draw-path (wedm:of-kind 'wire items))))))))

;; The path of each pass as a polyline, in place of what was drawn before.
(defun wedm:draw-path (wires)
  (wedm:begin-group)
  (wedm:clear wedm:path-layer)
  (wedm:layer wedm:path-layer "4")
  (foreach wire wires
    (entmake
      (append
        (list '(0 . "LWPOLYLINE") '(100 . "AcDbEntity") '(410 . "Model") (cons 8 wedm:path-layer) '(100 . "AcDbPolyline")
              (cons 90 (length (wedm:vertices (wedm:get 'vertices wire)))) '(70 . 0))
        (wedm:get 'vertices wire))))
  (wedm:end-group)
  (wedm:say 'drawn nil))

(defun c:WEDM3B () (wedm:generate "3b"))
(defun c:WEDM4B () (wedm:generate "4b"))
(defun c:WEDMISO () (wedm:generate "iso"))

;;; The page in the browser.

(setq wedm:shown-files nil)   ; those whose page was opened in this session

;; The page lives as long as its program, which gets a window that is minimized. Whether there is one that knows `view` shows the
;; answer to another command: both came at the same time.
(defun c:WEDMVIEW ( / *error* file)
  (setq *error* wedm:failed)
  (wedm:begin)
  (if (and (setq file (wedm:dxf))
           (wedm:ask (strcat "check " (wedm:quoted file)))
           (or (not (member file wedm:shown-files)) (wedm:opens-again file)))
    (progn
      (startapp "cmd.exe"
        (strcat "/d /s /c \"start \"wedm\" /min " (wedm:quoted (wedm:program))
                " view " (wedm:quoted file) " --lang " (wedm:language) "\""))
      (setq wedm:shown-files (cons file wedm:shown-files))
      (wedm:say 'viewed (list file))))
  (wedm:end))

(defun wedm:opens-again (file)
  (initget "Yes No")
  (= (getkword (strcat "\n" (wedm:text 'start-again (list file)))) "Yes"))

(princ)
