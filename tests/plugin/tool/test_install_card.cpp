// The card that installs the renderer, with an installer that only says what a real one would.
#include "tool/panel/install_card.h"
#include "worker/interpreter.h"

#include <QDir>
#include <QFile>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QtTest>

using namespace lampblack;

namespace
{
constexpr int Patience = 60000; // Python starts slowly on a busy machine
}

class InstallCardTest : public QObject
{
    Q_OBJECT

    QTemporaryDir mFolder{QDir::tempPath() + QStringLiteral("/Möwe und Kuh-XXXXXX")};
    std::unique_ptr<InstallCard> mCard;

    /// `answers` is Python, run for install; `state` is what plan says.
    void make(const char* state, const char* answers)
    {
        QFile script(mFolder.filePath(QStringLiteral("install_worker.py")));
        QVERIFY(script.open(QIODevice::WriteOnly));
        script.write("import sys, time\ndef say(t): print(t, flush=True)\nif sys.argv[1] == 'plan':\n "
                     "say('{\"say\": \"plan\", "
                     "\"state\": \"");
        script.write(state);
        script.write(
            "\", \"version\": \"9.0\", \"folder\": \"/home/anna/lampblack\", \"download\": 546000000, "
            "\"disk\": 1532000000}')\n say('{\"say\": \"done\"}')\nelse:\n ");
        script.write(answers);
        script.write("\n");
        script.close();
        mCard = std::make_unique<InstallCard>(mFolder.path());
        mCard->ask();
        QTRY_VERIFY_WITH_TIMEOUT(!mCard->isHidden(), Patience);
    }

    QString text(const char* name) { return find<QLabel>(name)->text(); }
    template <class Widget> Widget* find(const char* name)
    {
        return mCard->findChild<Widget*>(QStringLiteral("lampblack.panel.install.") + QLatin1String(name));
    }
    bool shows(const char* name) { return !find<QWidget>(name)->isHidden(); }

private Q_SLOTS:
    void itSaysWhatWhereAndHowLargeAndAsksOnce()
    {
        make("absent", "say('{\"say\": \"done\"}')");
        QVERIFY(text("what").contains(QStringLiteral("version 9.0")));
        QVERIFY(text("how").contains(QStringLiteral("/home/anna/lampblack")));
        QVERIFY(text("how").contains(QStringLiteral("546")));
        QVERIFY(text("how").contains(QStringLiteral("1.5 GB")) ||
                text("how").contains(QStringLiteral("1,5 GB")));
        QVERIFY(shows("install") && shows("folder") && !shows("cancel") && !shows("copy"));
        QSignalSpy installed(mCard.get(), &InstallCard::installed);
        find<QToolButton>("install")->click();
        QTRY_COMPARE_WITH_TIMEOUT(installed.count(), 1, Patience);
        QVERIFY(mCard->isHidden());
    }

    void itShowsHowFarItIsAndCanBeCancelled()
    {
        make("half",
             "say('{\"say\": \"progress\", \"what\": \"bpy==5.0.1\", \"done\": 250, \"total\": 1000}')\n "
             "time.sleep(60)");
        QVERIFY(text("what").contains(QStringLiteral("not finished")));
        find<QToolButton>("install")->click();
        QTRY_COMPARE_WITH_TIMEOUT(find<QProgressBar>("bar")->value(), 250, Patience);
        QVERIFY(shows("bar") && shows("cancel") && !shows("install"));
        QVERIFY(text("how").startsWith(QStringLiteral("bpy==5.0.1: ")));
        find<QToolButton>("cancel")->click();
        QTRY_VERIFY_WITH_TIMEOUT(shows("install"), Patience);
        QVERIFY(text("how").startsWith(QStringLiteral("Cancelled.")));
        QVERIFY(!shows("copy")); // that is no fault
    }

    void aFaultSaysWhatToDoAndInstallGoesOn()
    {
        make("other",
             "say('{\"say\": \"error\", \"what\": \"The disk is full.\", \"remedy\": \"Make room.\", "
             "\"details\": \"pip\"}'); sys.exit(1)");
        QCOMPARE(find<QToolButton>("install")->text(), QStringLiteral("Update"));
        find<QToolButton>("install")->click();
        QTRY_COMPARE_WITH_TIMEOUT(text("what"), QStringLiteral("The disk is full."), Patience);
        QCOMPARE(text("how"), QStringLiteral("Make room."));
        QTRY_VERIFY_WITH_TIMEOUT(shows("copy") && shows("install"), Patience);
    }

    void anInstallerThatBreaksIsTold()
    {
        make("absent", "raise SystemError");
        find<QToolButton>("install")->click();
        QTRY_COMPARE_WITH_TIMEOUT(text("what"), QStringLiteral("The installer ended too early."), Patience);
    }

    void onlyAWholeWorkerOfThisVersionIsUsed()
    {
        const QTemporaryDir data;
        qputenv("XDG_DATA_HOME", data.path().toUtf8());
        qunsetenv("LAMPBLACK_PYTHON"); // as in a test run, it would name the worker
        QFile note(mFolder.filePath(QStringLiteral("lampblack.json")));
        QVERIFY(note.open(QIODevice::WriteOnly));
        note.write("{\"installer\": \"/usr/share/lampblack\"}");
        note.close();
        const Interpreter found = findInterpreter(mFolder.path());
        QCOMPARE(found.path, data.filePath(QStringLiteral("lampblack/worker/bin/python")));
        QVERIFY(isToInstall(found));
        QVERIFY(QDir(data.path()).mkpath(QStringLiteral("lampblack/worker/bin")));
        QVERIFY(QFile::link(QStringLiteral("/bin/true"), found.path));
        QVERIFY(isToInstall(found)); // half of it
        const auto mark = [&data](const char* text)
        {
            QFile marker(data.filePath(QStringLiteral("lampblack/worker/complete.json")));
            marker.open(QIODevice::WriteOnly);
            marker.write(text);
        };
        mark("{\"version\": \"0.0.1\"}");
        QVERIFY(isToInstall(found));
        mark("{\"version\": \"" LAMPBLACK_VERSION "\"}");
        QVERIFY(!isToInstall(found));
        QCOMPARE(installedVersion(found), QStringLiteral(LAMPBLACK_VERSION));
        QVERIFY(!isToInstall({found.path, found.source}));
    }
};

QTEST_MAIN(InstallCardTest)
#include "test_install_card.moc"
