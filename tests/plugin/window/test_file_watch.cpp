// A drawing that is saved is noticed, however its program saves.
#include "window/file_watch.h"

#include <QDir>
#include <QTemporaryDir>
#include <QtTest>

namespace lampblack
{

class TestFileWatch : public QObject
{
    Q_OBJECT

    static constexpr int NoticedMs = 10000;
    static constexpr int UnnoticedMs = 1500;

    void write(const QString& name, const QByteArray& content) const
    {
        QFile file(mFolder->filePath(name));
        QVERIFY(file.open(QFile::WriteOnly));
        QCOMPARE(file.write(content), qint64(content.size()));
    }
    /// Under another name first, which then takes the place of the file.
    void saveOver(const QString& name, const QByteArray& content) const
    {
        write(QStringLiteral("new"), content);
        QVERIFY(QFile::remove(mFolder->filePath(name)));
        QVERIFY(QFile::rename(mFolder->filePath(QStringLiteral("new")), mFolder->filePath(name)));
    }

    std::unique_ptr<QTemporaryDir> mFolder;

private Q_SLOTS:
    void init()
    {
        mFolder = std::make_unique<QTemporaryDir>();
        write(QStringLiteral("hero.png"), "one");
    }

    void aFileIsNoticedEachTimeThatItIsReplaced()
    {
        FileWatch watch;
        watch.watch(mFolder->filePath(QStringLiteral("hero.png")));
        QSignalSpy changed(&watch, &FileWatch::changed);
        saveOver(QStringLiteral("hero.png"), "two words");
        QVERIFY(changed.wait(NoticedMs));
        saveOver(QStringLiteral("hero.png"), "three words now");
        QVERIFY(changed.wait(NoticedMs));
        write(QStringLiteral("hero.png"), "in its place");
        QVERIFY(changed.wait(NoticedMs));
        QCOMPARE(changed.size(), 3);
    }

    void filesBesideItAreNot()
    {
        FileWatch watch;
        watch.watch(mFolder->filePath(QStringLiteral("hero.png")));
        QSignalSpy changed(&watch, &FileWatch::changed);
        write(QStringLiteral("hero.png.lampblack.json"), "{}");
        QVERIFY(!changed.wait(UnnoticedMs));
    }

    void aFileThatIsAwayForAMomentIsNoticedWhenItIsBack()
    {
        FileWatch watch;
        watch.watch(mFolder->filePath(QStringLiteral("hero.png")));
        QSignalSpy changed(&watch, &FileWatch::changed);
        QVERIFY(QFile::remove(mFolder->filePath(QStringLiteral("hero.png"))));
        QVERIFY(!changed.wait(UnnoticedMs));
        write(QStringLiteral("hero.png"), "back again");
        QVERIFY(changed.wait(NoticedMs));
    }

    void framesOfAFolderAreNoticed()
    {
        FileWatch watch;
        watch.watch(mFolder->path());
        QSignalSpy changed(&watch, &FileWatch::changed);
        write(QStringLiteral("hero.png"), "drawn again");
        QVERIFY(changed.wait(NoticedMs));
        write(QStringLiteral("next.png"), "new");
        QVERIFY(changed.wait(NoticedMs));
        write(QStringLiteral("next.png"), "and again");
        QVERIFY(changed.wait(NoticedMs));
    }
};

} // namespace lampblack

QTEST_GUILESS_MAIN(lampblack::TestFileWatch)
#include "test_file_watch.moc"
