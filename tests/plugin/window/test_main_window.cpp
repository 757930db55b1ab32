// The window of lampblack-window.
#include "window/main_window.h"

#include <QLabel>
#include <QtTest>

using namespace lampblack;

class MainWindowTest : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void theLabelTellsWhichOfItsFramesIsShown_data()
    {
        QTest::addColumn<int>("first");
        QTest::addColumn<int>("last");
        QTest::addColumn<int>("frame");
        QTest::addColumn<QString>("text");
        QTest::newRow("from 1") << 1 << 13 << 3 << QStringLiteral("Frame 3 of 13");
        QTest::newRow("a part of a shot") << 11 << 13 << 13 << QStringLiteral("Frame 13 (11 to 13)");
        QTest::newRow("from 0") << 0 << 4 << 4 << QStringLiteral("Frame 4 (0 to 4)");
    }

    void theLabelTellsWhichOfItsFramesIsShown()
    {
        QFETCH(int, first);
        QFETCH(int, last);
        QFETCH(int, frame);
        MainWindow window;
        window.setFrames({first, last});
        window.setFrame(frame);
        QTEST(window.findChild<QLabel*>(QStringLiteral("lampblack.window.number"))->text(), "text");
    }
};

QTEST_MAIN(MainWindowTest)
#include "test_main_window.moc"
