using System;
using System.Collections.Generic;
using System.Drawing;
using System.Globalization;
using System.Linq;
using System.Windows.Forms;
using Wedm.Core;

namespace Wedm.AutoCad
{
    /// <summary>The list of the palette: entity, vertex, radius, verdict. Knows nothing of AutoCAD.</summary>
    public sealed class RadiusPanel : UserControl
    {
        private readonly ListView _list = new ListView();
        private readonly Label _status = new Label();
        private readonly CheckBox _onlyFaults = new CheckBox();
        private IReadOnlyList<RadiusRow> _all = new RadiusRow[0];
        private RadiusRow[] _shown = new RadiusRow[0];

        public RadiusPanel()
        {
            var check = new Button { Text = "Check", AutoSize = true };
            var fix = new Button { Text = "Fix all", AutoSize = true };
            check.Click += (sender, nothing) => CheckWanted?.Invoke();
            fix.Click += (sender, nothing) => FixWanted?.Invoke();
            _onlyFaults.Text = "Faults only";
            _onlyFaults.AutoSize = true;
            _onlyFaults.Checked = true;
            _onlyFaults.CheckedChanged += (sender, nothing) => Fill();
            var bar = new FlowLayoutPanel { Dock = DockStyle.Top, AutoSize = true };
            bar.Controls.AddRange(new Control[] { check, fix, _onlyFaults });

            // A virtual list: a drawing may have hundreds of thousands of rows.
            _list.VirtualMode = true;
            _list.View = View.Details;
            _list.FullRowSelect = true;
            _list.MultiSelect = false;
            _list.HideSelection = false;
            _list.Dock = DockStyle.Fill;
            _list.Columns.Add("Entity", 60);
            _list.Columns.Add("Vertex", 55, HorizontalAlignment.Right);
            _list.Columns.Add("X", 75, HorizontalAlignment.Right);
            _list.Columns.Add("Y", 75, HorizontalAlignment.Right);
            _list.Columns.Add("Radius", 75, HorizontalAlignment.Right);
            _list.Columns.Add("Verdict", 150);
            _list.RetrieveVirtualItem += (sender, wanted) => wanted.Item = Item(_shown[wanted.ItemIndex]);
            _list.ItemActivate += (sender, nothing) => ActivateSelected();

            _status.Dock = DockStyle.Bottom;
            _status.AutoSize = false;
            _status.Height = 36;
            Controls.Add(_list);
            Controls.Add(bar);
            Controls.Add(_status);
        }

        public event Action CheckWanted;

        public event Action FixWanted;

        /// <summary>A row was double-clicked, or Enter pressed on it.</summary>
        public event Action<RadiusRow> RowActivated;

        /// <summary>What is in the drawing and not in the list; null where that is nothing.</summary>
        public string LeftOut { get; set; }

        /// <summary>Rows that stand in the list now.</summary>
        public int ShownCount => _shown.Length;

        public void Show(IReadOnlyList<RadiusRow> rows)
        {
            _all = rows;
            Fill();
        }

        public void Say(string sentence)
        {
            _status.Text = sentence;
        }

        private void Fill()
        {
            _shown = _onlyFaults.Checked ? _all.Where(row => row.IsAtFault).ToArray() : _all.ToArray();
            _list.VirtualListSize = _shown.Length;
            _list.Invalidate();
            var faults = _all.Count(row => row.IsAtFault);
            Say(_all.Count + " segments, " + (faults == 0 ? "all ok" : faults + " not ok") + (LeftOut == null ? "" : "; not checked: " + LeftOut));
        }

        private void ActivateSelected()
        {
            if (_list.SelectedIndices.Count == 1)
            {
                RowActivated?.Invoke(_shown[_list.SelectedIndices[0]]);
            }
        }

        private static ListViewItem Item(RadiusRow row)
        {
            var texts = new[]
            {
                row.Handle,
                row.Vertex.ToString(CultureInfo.CurrentCulture),
                Length(row.X),
                Length(row.Y),
                row.Radius == null ? "line" : Length(row.Radius.Value),
                row.Verdict,
            };
            return new ListViewItem(texts) { ForeColor = row.IsAtFault ? Color.Firebrick : SystemColors.WindowText };
        }

        private static string Length(double value) => value.ToString("0.000", CultureInfo.CurrentCulture);
    }
}
