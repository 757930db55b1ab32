// WorkerProcess starts, watches, restarts and ends the worker.
#include "worker/worker_process.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QSignalSpy>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QtTest>

#include <csignal>

using namespace lampblack;

namespace
{

Interpreter fake()
{
    return {QStringLiteral(LAMPBLACK_FAKE_WORKER), QStringLiteral("the test")};
}

bool isAlive(qint64 pid)
{
    return kill(static_cast<pid_t>(pid), 0) == 0;
}

} // namespace

class TestWorkerProcess : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init()
    {
        mFolder = std::make_unique<QTemporaryDir>();
        qputenv("LAMPBLACK_FAKE_FOLDER", mFolder->path().toLocal8Bit());
        qputenv("LAMPBLACK_FAKE", "good");
    }

    void itsEnvironmentIsClean()
    {
        qputenv("PYTHONPATH", "/nowhere");
        qputenv("QT_PLUGIN_PATH", "/nowhere");
        qputenv("XDG_RUNTIME_DIR", "/nowhere");
        WorkerProcess process(fake());
        const QSignalSpy ready(&process, &WorkerProcess::ready);
        process.start();
        QTRY_COMPARE(ready.count(), 1);
        QFile file(QStringLiteral("/proc/%1/environ").arg(process.pid()));
        QVERIFY(file.open(QIODevice::ReadOnly));
        const QList<QByteArray> environment = file.readAll().split('\0');
        QVERIFY(environment.contains("LAMPBLACK_FAKE=good"));
        for (const QByteArray& entry : environment)
        {
            QVERIFY2(!entry.startsWith("PYTHON") && !entry.startsWith("QT_") &&
                         !entry.startsWith("XDG_RUNTIME_DIR") && !entry.startsWith("LD_"),
                     entry.constData());
        }
        qunsetenv("PYTHONPATH");
        qunsetenv("QT_PLUGIN_PATH");
        qunsetenv("XDG_RUNTIME_DIR");
    }

    void codeInTheCurrentFolderIsNotRun()
    {
        const QString python = QStandardPaths::findExecutable(QStringLiteral("python3"));
        if (python.isEmpty())
        {
            QSKIP("there is no Python");
        }
        const QString before = QDir::currentPath();
        QVERIFY(QDir::setCurrent(mFolder->path()));
        QFile trap(QStringLiteral("lampblack.py"));
        QVERIFY(trap.open(QIODevice::WriteOnly));
        trap.write("open(__file__ + '.ran', 'w')\n");
        trap.close();
        WorkerProcess process({python, QStringLiteral("the test")});
        const QSignalSpy gaveUp(&process, &WorkerProcess::gaveUp);
        const QSignalSpy ready(&process, &WorkerProcess::ready); // this Python may have Lampblack
        process.start();
        QTRY_COMPARE_WITH_TIMEOUT(gaveUp.count() + ready.count(), 1, 60000);
        QVERIFY(!QFile::exists(QStringLiteral("lampblack.py.ran")));
        QVERIFY(QDir::setCurrent(before));
    }

    void itIsStartedInItsOwnFolder()
    {
        WorkerProcess process(fake());
        const QSignalSpy ready(&process, &WorkerProcess::ready);
        process.start();
        QTRY_COMPARE(ready.count(), 1);
        const QString folder = QFile::symLinkTarget(QStringLiteral("/proc/%1/cwd").arg(process.pid()));
        QVERIFY2(QFileInfo(folder).fileName().startsWith(QStringLiteral("lampblack-")), qPrintable(folder));
    }

    void killedItIsStartedAgainAndLeavesNothing()
    {
        WorkerProcess process(fake());
        const QSignalSpy ready(&process, &WorkerProcess::ready);
        const QSignalSpy lost(&process, &WorkerProcess::lost);
        process.start();
        QTRY_COMPARE(ready.count(), 1);
        const qint64 first = process.pid();
        kill(static_cast<pid_t>(first), SIGKILL);
        QTRY_COMPARE(ready.count(), 2);
        QCOMPARE(lost.count(), 1);
        QVERIFY(process.pid() != first);
        const QString endpoint = ready[0][0].toString();
        QVERIFY(!QFileInfo::exists(QFileInfo(endpoint.mid(6)).absolutePath()));
    }

    void dyingAgainAndAgainItIsGivenUpInWords()
    {
        qputenv("LAMPBLACK_FAKE", "absent");
        WorkerProcess process(fake());
        QSignalSpy gaveUp(&process, &WorkerProcess::gaveUp);
        const QSignalSpy lost(&process, &WorkerProcess::lost);
        process.start();
        QVERIFY(gaveUp.wait(15000));
        QCOMPARE(lost.count(), 3);
        QVERIFY(!process.isRunning());
        const auto error = gaveUp[0][0].value<UserError>();
        QVERIFY(error.remedy.contains(QStringLiteral(" -m lampblack doctor")));
        QVERIFY(error.details.contains(QStringLiteral("It refuses to start.")));
    }

    void withoutAnInterpreterOneSentenceAndWhatToType_data()
    {
        QTest::addColumn<QString>("path");
        QTest::newRow("nameless") << QString();
        QTest::newRow("missing") << "/nowhere/python";
        QTest::newRow("folder") << "/tmp";
    }

    void withoutAnInterpreterOneSentenceAndWhatToType()
    {
        QFETCH(QString, path);
        WorkerProcess process({path, QStringLiteral("the test")});
        const QSignalSpy gaveUp(&process, &WorkerProcess::gaveUp);
        process.start();
        QCOMPARE(gaveUp.count(), 0);
        QTRY_COMPARE(gaveUp.count(), 1);
        const auto error = gaveUp[0][0].value<UserError>();
        QCOMPARE(error.what, QStringLiteral("The renderer of Lampblack is not installed."));
        QVERIFY(error.remedy.contains(QStringLiteral("make install")));
    }

    void aPythonWithoutLampblackIsToldAtOnce()
    {
        QFile script(mFolder->filePath(QStringLiteral("python")));
        QVERIFY(script.open(QIODevice::WriteOnly));
        script.write("#!/bin/sh\necho \"$0: No module named lampblack\" >&2\nexit 1\n");
        script.close();
        QVERIFY(script.setPermissions(QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner));
        WorkerProcess process({script.fileName(), QStringLiteral("the test")});
        const QSignalSpy gaveUp(&process, &WorkerProcess::gaveUp);
        process.start();
        QTRY_COMPARE(gaveUp.count(), 1);
        QCOMPARE(gaveUp[0][0].value<UserError>().what,
                 QStringLiteral("The renderer of Lampblack is not installed."));
    }

    void anotherVersionIsNotConnectedTo()
    {
        qputenv("LAMPBLACK_FAKE", "other_file");
        WorkerProcess process(fake());
        const QSignalSpy ready(&process, &WorkerProcess::ready);
        const QSignalSpy gaveUp(&process, &WorkerProcess::gaveUp);
        process.start();
        QTRY_COMPARE(gaveUp.count(), 1);
        QCOMPARE(ready.count(), 0);
        QVERIFY(gaveUp[0][0].value<UserError>().what.contains(QStringLiteral("version")));
    }

    void itEndsWithItsOwner()
    {
        qint64 pid = 0;
        {
            WorkerProcess process(fake());
            const QSignalSpy ready(&process, &WorkerProcess::ready);
            process.start();
            QTRY_COMPARE(ready.count(), 1);
            pid = process.pid();
            QVERIFY(isAlive(pid));
        }
        QVERIFY(!isAlive(pid));
    }

    void stoppedItEndsWithoutMakingAnyoneWait()
    {
        WorkerProcess process(fake());
        const QSignalSpy ready(&process, &WorkerProcess::ready);
        process.start();
        QTRY_COMPARE(ready.count(), 1);
        const qint64 pid = process.pid();
        process.stop();
        QVERIFY(!process.isRunning());
        QTRY_VERIFY(!isAlive(pid));
        process.start();
        QTRY_COMPARE(ready.count(), 2);
    }

private:
    std::unique_ptr<QTemporaryDir> mFolder;
};

QTEST_GUILESS_MAIN(TestWorkerProcess)
#include "test_process.moc"
