using System;
using System.ComponentModel;
using System.Diagnostics;
using System.IO;

namespace Wedm.Core
{
    /// <summary>The running server: a process whose pipes carry the protocol, and whose log is kept for a fault report.</summary>
    internal sealed class ServerProcess : IDisposable
    {
        private readonly Process _process;
        private volatile string _lastLogLine;

        /// <exception cref="ServerMissingException">The program cannot be started.</exception>
        public ServerProcess(string path)
        {
            var start = new ProcessStartInfo(path, "serve")
            {
                UseShellExecute = false,
                CreateNoWindow = true,
                RedirectStandardInput = true,
                RedirectStandardOutput = true,
                RedirectStandardError = true,
            };
            try
            {
                _process = Process.Start(start);
            }
            catch (Exception fault) when (fault is Win32Exception || fault is InvalidOperationException)
            {
                throw new ServerMissingException(path + " cannot be started: " + fault.Message);
            }
            // The log must be read, or a server that writes a lot would block for ever.
            _process.ErrorDataReceived += (sender, line) => _lastLogLine = line.Data ?? _lastLogLine;
            _process.BeginErrorReadLine();
            Connection = new Connection(_process.StandardOutput.BaseStream, _process.StandardInput.BaseStream);
        }

        public Connection Connection { get; }

        public int Id => _process.Id;

        /// <summary>The last line of the server's log, null where it is empty.</summary>
        public string LastLogLine => _lastLogLine;

        public void Kill()
        {
            try
            {
                _process.Kill();
            }
            catch (Exception fault) when (fault is InvalidOperationException || fault is Win32Exception)
            {
                // It has ended by itself.
            }
        }

        public void Dispose()
        {
            Connection.Dispose();
            if (!_process.WaitForExit(1000))
            {
                Kill();
            }
            _process.Dispose();
        }
    }
}
